"""Draw the macro's icon, a part and its medial axis under a lens: draw_icon.py PART.

The profile comes from the part's sidecar, so scan it before.
"""

import sys
from pathlib import Path

import numpy as np

from mashape_cad.library.sidecar import read_sidecar, sidecar_path
from mashape_cad.views.colours import ACCENT, PAPER
from mashape_cad.views.drawing import Circle, Drawing, Lines, Placement
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.profile_panel import axis_lines, outline
from mashape_cad.views.raster import png

SIDE = 64.0
CENTRE, RADIUS, LINE = (28.0, 28.0), 24.0, 4.5


def icon(part: Path) -> Drawing:
    """Return the icon of a part."""
    likeness = Likeness.of_record(read_sidecar(sidecar_path(part)).profiles[0])
    inside = 1.36 * RADIUS
    placement = Placement.fitting(likeness.bounds, CENTRE[0] - inside / 2, CENTRE[1] - inside / 2, inside, inside)
    grip = np.array([(46.5, 46.5), (58.5, 58.5)])
    shapes = (
        Lines((grip,), PAPER.ink, 9.0),
        Circle(*CENTRE, RADIUS, "#ffffff", PAPER.ink, LINE),
        *outline(likeness, placement, PAPER, 1.6),
        *axis_lines(likeness, placement, PAPER, 2.2),
        Circle(*CENTRE, RADIUS, "none", ACCENT, 1.0),
    )
    return Drawing(SIDE, SIDE, "Find similar profiles", shapes)


if __name__ == "__main__":
    Path(__file__).with_name("FindSimilarProfiles.png").write_bytes(png(icon(Path(sys.argv[1])), density=4.0))
