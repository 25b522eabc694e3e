import io

import matplotlib.image
import numpy as np

from mashape_cad.views.drawing import Area, Circle, Difference, Drawing, Label, Lines, rectangle
from mashape_cad.views.raster import png


def pixels(*shapes, density=1.0):
    """RGB values, rows from top to bottom."""
    content = png(Drawing(60, 40, "a part", shapes, "#ffffff"), density)
    assert content.startswith(b"\x89PNG")
    return np.rint(matplotlib.image.imread(io.BytesIO(content))[..., :3] * 255).astype(int)


def test_a_canvas_pixel_is_as_many_dots_as_asked_for():
    """60 x 40 pixels at two dots each."""
    assert pixels(density=2.0).shape == (80, 120, 3)


def test_areas_lie_where_the_canvas_says():
    """Left and top as in the drawing: y runs downwards."""
    image = pixels(Area((rectangle(5, 10, 20, 8),), "#ff0000"))
    assert image[12, 10].tolist() == [255, 0, 0]
    assert image[35, 10].tolist() == [255, 255, 255]
    assert image[12, 40].tolist() == [255, 255, 255]


def test_holes_are_left_out_whichever_way_they_run():
    """Clockwise or not."""
    hole = rectangle(20, 15, 10, 10)
    for ring in (hole, hole[::-1]):
        image = pixels(Area((rectangle(5, 5, 50, 30), ring), "#0000ff"))
        assert image[20, 25].tolist() == [255, 255, 255]
        assert image[8, 8].tolist() == [0, 0, 255]


def test_later_shapes_lie_on_top():
    """Whatever their kinds."""
    area = Area((rectangle(0, 0, 60, 40),), "#00ff00")
    line = Lines((np.array([(0.0, 20.0), (60.0, 20.0)]),), "#ff0000", 6)
    circle = Circle(30, 20, 10, "#0000ff", "#0000ff", 1)
    assert pixels(area, line, circle)[20, 30].tolist() == [0, 0, 255]
    assert pixels(area, circle, line)[20, 30].tolist() == [255, 0, 0]
    assert pixels(circle, line, area)[20, 30].tolist() == [0, 255, 0]


def test_names_in_any_script_are_drawn_without_a_word():
    """Dollar signs are no formulas, and a missing glyph is no warning."""
    blank = pixels()
    for name in ("$a_{$", "零件.dxf", "\udce4"):
        assert not np.array_equal(pixels(Label(5, 20, name, 14, "#000000")), blank)


def test_the_same_drawing_gives_the_same_bytes():
    """No date, no version in the file."""
    drawing = Drawing(60, 40, "a part", (Label(5, 20, "words", 12, "#000000"),), "#ffffff")
    assert png(drawing) == png(drawing)
    assert b"matplotlib" not in png(drawing).lower()


def test_a_difference_is_what_only_one_profile_covers():
    """Holes count, and the ways in which rings run do not."""
    one, hole, other = rectangle(5, 5, 30, 30), rectangle(10, 10, 6, 6), rectangle(20, 5, 30, 30)
    for turn in (1, -1):
        image = pixels(Difference((one[::turn], hole), (other[::-turn],), "#ff0000"))
        red, white = [255, 0, 0], [255, 255, 255]
        places = [(7, 20), (13, 13), (28, 20), (45, 20), (55, 20)]
        assert [image[y, x].tolist() for x, y in places] == [red, white, white, red, white]
