"""An evaluation as text, CSV, JSON, page and pictures, all from one report."""

import csv
import html.parser
import io
import json
import math

import numpy as np
import pytest
from stand_ins import profile_record, put_part, tried

from mashape_cad.evaluation.labelled import labelled_set
from mashape_cad.evaluation.measures import Protocol
from mashape_cad.evaluation.modes import MODES
from mashape_cad.evaluation.published import TABLES
from mashape_cad.evaluation.report import report
from mashape_cad.views.evaluation_csv import COLUMNS, evaluation_csv
from mashape_cad.views.evaluation_json import evaluation_messages
from mashape_cad.views.evaluation_page import write_page, write_pictures
from mashape_cad.views.evaluation_rows import class_grid, paper_grid, percent
from mashape_cad.views.evaluation_text import grids, print_report

MEASURES = {"nearest_neighbour", "first_tier", "second_tier", "mean_average_precision", "bulls_eye"}


def made(folder, *, with_trials=True, modes=MODES):
    """The report of a folder of stand-ins."""
    labelled = labelled_set(folder)
    trials = {
        shape.path: tried(shape.path, shape.source.blake2b, shape.profile, labelled.options)
        for shape in labelled.shapes
        if with_trials
    }
    return report(labelled, modes, trials)


@pytest.fixture
def small(tmp_path):
    """Two classes of two, and one shape alone in its class, whose name needs care."""
    for name, *bins in (
        ("bolt-1", 0, 1, 2),
        ("bolt-2", 0, 1, 3),
        ("nut-1", 0, 1, 2, 2),
        ("nut-2", 20, 31),
        ("<b>&_1", 50),
    ):
        put_part(tmp_path / f"{name}.dxf", profile_record(*bins))
    return made(tmp_path)


@pytest.fixture
def paper_set(tmp_path):
    """The paper's classes, ten of each, every class with a bin of its own."""
    for number, name in enumerate(TABLES[0].tiers):
        for member in range(1, 11):
            put_part(tmp_path / f"{name}-{member}.dxf", profile_record(6 * number, 6 * number + 1 + member % 3))
    return tmp_path


def test_text_has_every_table(small):
    """And none of the paper's beside another set."""
    out = io.StringIO()
    print_report(small, out)
    text = out.getvalue()
    assert f"{small.labelled.folder}: 5 shapes in 3 classes\n" in text
    for title in ("Tiers by class, protocol paper", "protocol princeton", "All measures", "Sampling", "Running times"):
        assert title in text
    assert "Tab. 1" not in text
    assert "reconstruction" not in text


def test_the_class_table_says_what_was_measured(small):
    """A class of one has no figures; means are over the others."""
    grid = class_grid(small, Protocol.PRINCETON)
    rows = {row[0]: row for row in grid.rows}
    assert grid.headings[:3] == ("class", "shapes", "DF")
    assert rows["<b>&"][:3] == ("<b>&", "1", "- / -")
    first = small.full.result("paper-df", Protocol.PRINCETON).means["first_tier"]
    assert rows["mean"][2].startswith(f"{100 * first:.1f} / ")


def test_times_are_added_up(small):
    """Five shapes of 4, 2, 1/4, 1 and half a second."""
    [grid] = [grid for grid in grids(small) if grid.title == "Running times"]
    shown = [row[2] for row in grid.rows]
    assert shown[:4] == ["20.00", "10.00", "1.25", "5.00"]
    assert shown[5] == "2.50"
    assert float(shown[-1]) == pytest.approx(16.25 + float(shown[4]), abs=0.02)


def test_without_trials_there_is_neither_sampling_nor_times(small):
    """All else is the same."""
    quick = made(small.labelled.folder, with_trials=False)
    titles = [grid.title for grid in grids(quick)]
    assert titles == [each.title for each in grids(small) if each.title not in {"Sampling", "Running times"}]
    kinds = [json.loads(line)["message_type"] for line in evaluation_messages(quick)]
    assert set(kinds) == {"class", "summary"}


def test_the_papers_figures_stand_beside_its_own_classes(paper_set):
    """Tables 1 to 4, Table 4 from half the stations; ours are all found."""
    found = made(paper_set)
    grid = paper_grid(found)
    assert grid.headings[1:] == (
        "DF 0.01", "Tab. 1", "RF 0.01", "Tab. 2", "CF 0.01", "Tab. 3", "RF 0.02", "Tab. 4"
    )  # fmt: skip
    rows = {row[0]: row for row in grid.rows}
    assert rows["gear"][2::2] == ("44 / 66", "73 / 58", "56 / 74", "56 / 74")
    assert rows["gear"][1] == "100 / 100"
    assert rows["mean"][2::2] == ("67.1 / 78.5", "72.4 / 78.0", "68.0 / 79.0", "73.4 / 83.3")
    out = io.StringIO()
    print_report(found, out)
    assert "8 classes, a reconstruction of the paper's database" in out.getvalue()
    assert [row[3] for row in grids(found)[-1].rows] == ["", "10", "", "", "2", "", "2", "16"]


def test_only_the_papers_tables_that_were_measured_are_shown(paper_set):
    """Without trials Table 4 is missing, with one mode the others are."""
    assert [each for each in paper_grid(made(paper_set, with_trials=False)).headings if "Tab" in each] == [
        "Tab. 1", "Tab. 2", "Tab. 3"
    ]  # fmt: skip
    assert paper_grid(made(paper_set, modes=MODES[2:3])).headings == ("class", "CF 0.01", "Tab. 3")
    assert paper_grid(made(paper_set, modes=MODES[-1:])) is None


def test_json_lines_are_as_others_rely_on(small):
    """Class lines first, then a summary for each mode and protocol."""
    lines = [json.loads(line) for line in evaluation_messages(small)]
    kinds = [line["message_type"] for line in lines]
    assert kinds == sorted(kinds, key=["class", "sampling", "time", "summary"].index)
    classes = [line for line in lines if line["message_type"] == "class"]
    assert len(classes) == 3 * len(MODES) * 2
    for line in classes:
        assert {"mode", "protocol", "class", "first_tier", "second_tier"} <= set(line)
        assert (line["first_tier"] is None) == (line["class"] == "<b>&")
    summaries = [line for line in lines if line["message_type"] == "summary"]
    assert [(line["mode"], line["protocol"]) for line in summaries] == [
        (mode.name, protocol) for mode in MODES for protocol in ("paper", "princeton")
    ]
    for line in summaries:
        assert set(line) == {"message_type", "mode", "protocol", "shapes", "classes", "seconds"} | MEASURES
        assert (line["shapes"], line["classes"]) == (5, 3)
    assert {"paper-df", "paper-rf", "paper-cf", "paper-all"} <= {line["mode"] for line in summaries}


def test_json_gives_the_papers_figures_where_there_are_some(paper_set):
    """In its own protocol only."""
    lines = [json.loads(line) for line in evaluation_messages(made(paper_set))]
    given = {
        (line["mode"], line["protocol"]): line["paper"]
        for line in lines
        if line["message_type"] == "class" and line["class"] == "ell"
    }
    assert given["paper-rf", "paper"] == [0.41, 0.56]
    assert given["paper-rf", "princeton"] is None
    assert given["paper-all", "paper"] is None


def test_csv_has_a_line_for_each_class_and_mean(paper_set):
    """At both steps, with the paper's figures where it has some."""
    found = made(paper_set)
    rows = list(csv.DictReader(io.StringIO(evaluation_csv(found))))
    assert tuple(rows[0]) == COLUMNS
    assert len(rows) == 2 * len(MODES) * 2 * (8 + 1)
    by_key = {(row["mode"], row["protocol"], row["step"], row["class"]): row for row in rows}
    ours = by_key["paper-rf", "paper", "0.02", "bird"]
    assert (ours["shapes"], ours["paper_first_tier"], ours["paper_second_tier"]) == ("10", "0.49", "0.64")
    means = found.coarse.result("paper-rf", Protocol.PAPER).means
    assert float(by_key["paper-rf", "paper", "0.02", ""]["first_tier"]) == pytest.approx(means["first_tier"], abs=1e-6)
    assert by_key["paper-rf", "paper", "0.02", ""]["paper_first_tier"] == "0.73375"
    assert by_key["paper-df", "paper", "0.02", "bird"]["paper_first_tier"] == ""
    assert by_key["paper-rf", "princeton", "0.01", "bird"]["paper_first_tier"] == ""


def test_csv_leaves_empty_what_is_not_defined(small):
    """A class of one."""
    rows = csv.DictReader(io.StringIO(evaluation_csv(small)))
    assert {row["first_tier"] for row in rows if row["class"] == "<b>&"} == {""}


class Outline(html.parser.HTMLParser):
    """Collects what a page opens and closes, and its texts."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.texts, self.depth, self.tags = [], [], 0, []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """See the base class."""
        self.tags.append(tag)
        self.ids += [value for name, value in attrs if name == "id"]
        assert not [value for name, value in attrs if name in {"src", "href"}], "the page is self-contained"

    def handle_data(self, data):
        """See the base class."""
        self.texts.append(data.strip())


def test_the_page_has_tables_and_sheets(small, tmp_path):
    """All in one file; names cannot break out of it."""
    out = tmp_path / "report.html"
    write_page(out, small)
    text = out.read_text(encoding="utf-8")
    page = Outline(text)
    assert "<b>" not in text
    assert "<b>&" in page.texts
    assert page.tags.count("table") == len(grids(small))
    drawn = ["paper-df", "paper-rf", "paper-cf", "paper-all", "default", "reranked"]
    hits = [f"{kind}-hits-{mode}" for mode in drawn for kind in ("first", "all")]
    assert page.ids == ["database", *hits, "axes", "signatures"]
    assert "of the paper" not in text.split("<main>")[1].split("<details")[1]


def test_a_wrong_hit_is_marked_and_the_query_comes_first(small):
    """The nearest of bolt 1 is a nut."""
    from mashape_cad.views.colours import PAPER
    from mashape_cad.views.drawing import Area, Label
    from mashape_cad.views.evaluation_sheets import sheets

    drawing = {sheet.name: sheet.drawing for sheet in sheets(small, PAPER)}["first-hits-paper-df"]
    labels = [shape for shape in drawing.shapes if isinstance(shape, Label)]
    names = [label.text for label in labels]
    start = names.index("bolt-1")
    query, hit = labels[start : start + 2]
    assert (query.bold, query.colour == PAPER.wrong) == (True, False)
    assert (hit.text, hit.colour, hit.bold) == ("nut-1", PAPER.wrong, False)
    frames = [shape for shape in drawing.shapes if isinstance(shape, Area) and shape.fill == "none"]
    assert sum(frame.stroke == PAPER.wrong for frame in frames) == sum(label.colour == PAPER.wrong for label in labels)


def test_sheets_name_the_figures_they_follow(paper_set):
    """And say that this is a reconstruction."""
    from mashape_cad.views.colours import PAPER
    from mashape_cad.views.evaluation_sheets import sheets

    captions = {sheet.name: sheet.caption for sheet in sheets(made(paper_set), PAPER)}
    for name, figure in (("database", "Figure 10"), ("all-hits-paper-rf", "14"), ("first-hits-paper-cf", "18")):
        assert figure in captions[name]
        assert "reconstruction" in captions[name]
    titles = {sheet.name: sheet.title for sheet in sheets(made(paper_set), PAPER)}
    assert titles["all-hits-paper-rf"] == "All that gear-1 finds by RF"


def test_every_sheet_becomes_a_png(small, tmp_path):
    """In a folder that is made for them."""
    written = write_pictures(tmp_path / "new" / "sheets", small)
    assert len(written) == 15
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in written)


def test_a_share_that_is_not_defined_is_a_dash():
    """Not a nan."""
    assert (percent(math.nan), percent(0.125), percent(np.float64(1))) == ("-", "13", "100")
