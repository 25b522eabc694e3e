# ruff: noqa: RUF001  -- the sign of multiplication is meant

import html.parser
import re
from dataclasses import replace
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

from mashape_cad.errors import MashapeError
from mashape_cad.geometry.edge import Similarity
from mashape_cad.library.match import Match
from mashape_cad.matching.portion import Portion
from mashape_cad.matching.relation import Kind, Relation
from mashape_cad.views.colours import ACCENT
from mashape_cad.views.page import write_sheet

NAMES = ("gear.dxf", "Träger <1> & Söhne.step", 'a"quoted".dxf', "odd\udce4.dxf")


@pytest.fixture
def matches(plate):
    """Four matches with names that are hard to write down."""
    return [Match(i + 1, Path("parts") / name, i, 0.25 * i, plate, 50.0) for i, name in enumerate(NAMES)]


class Reader(html.parser.HTMLParser):
    """Collects the text of every element by its class, and all attributes."""

    def __init__(self, text):
        super().__init__()
        self.texts, self.attributes, self._open = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """See the base class."""
        self._open.append((tag, dict(attrs)))
        self.attributes += [(tag, name, value) for name, value in attrs]

    def handle_endtag(self, tag):
        """See the base class."""
        while self._open and self._open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        """See the base class."""
        if data.strip() and self._open:
            tag, attrs = self._open[-1]
            self.texts.append((attrs.get("class", tag), data.strip()))

    def of(self, kind):
        """All texts of one class, or of one tag without class."""
        return [text for found, text in self.texts if found == kind]


def page(tmp_path, *arguments):
    """The text of the page that is written."""
    out = tmp_path / "answer.html"
    write_sheet(out, *arguments)
    return out.read_text(encoding="utf-8")


def test_the_query_comes_first_and_matches_follow_in_order(plate, matches, tmp_path):
    """With rank, name, score and size."""
    shown = Reader(page(tmp_path, plate, matches, "query.dxf"))
    assert shown.of("rank") == ["query", "1", "2", "3", "4"]
    assert shown.of("name") == ["query.dxf", *NAMES[:3], "odd\ufffd.dxf"]
    assert shown.of("facts")[:2] == ["50.0 × 20.0 mm", "score 50 · 50.0 × 20.0 mm"]
    assert shown.of("facts")[4] == "score 50 · 50.0 × 20.0 mm"
    assert shown.of("h1") == ["Parts like query.dxf"]


def test_every_part_is_drawn_and_described(plate, matches, tmp_path):
    """One picture each, with a text for those who cannot see it."""
    shown = Reader(page(tmp_path, plate, matches, "query.dxf"))
    spoken = [value for tag, name, value in shown.attributes if (tag, name) == ("svg", "aria-label")]
    assert len(spoken) == 5
    assert spoken[2] == "2: Träger <1> & Söhne.step, score 50 · 50.0 × 20.0 mm"


def test_names_cannot_break_out(plate, matches, tmp_path):
    """Markup in a name is shown, not obeyed."""
    evil = "<script>alert(1)</script>.dxf"
    text = page(tmp_path, plate, [replace(matches[0], path=Path("parts") / evil)], evil)
    assert "<script" not in text
    assert evil in Reader(text).of("name")


def test_the_page_stands_alone(plate, matches, tmp_path):
    """Nothing is fetched, so that it works offline and tells nobody."""
    text = page(tmp_path, plate, matches, "query.dxf").replace('xmlns="http://www.w3.org/2000/svg"', "")
    assert not re.search(r"https?:|//|\bsrc=|\bhref=|url\(|@import|<script", text)


def test_every_colour_that_a_tile_uses_is_defined_by_day_and_by_night(plate, matches, tmp_path):
    """The pictures name colours, the style sheet says what they are."""
    text = page(tmp_path, plate, matches, "query.dxf")
    day, night = re.findall(r":root \{(.*?)\}", text, flags=re.DOTALL)
    used = set(re.findall(r"var\((--[a-z0-9]+)\)", text))
    assert used <= set(re.findall(r"(--[a-z0-9]+):", day))
    assert used <= set(re.findall(r"(--[a-z0-9]+):", night))


def test_where_a_match_lies_is_told_on_its_name(plate, matches, tmp_path):
    """Path and, if it is not the first, the profile."""
    shown = Reader(page(tmp_path, plate, matches, "query.dxf"))
    places = [value for tag, name, value in shown.attributes if (tag, name) == ("span", "title")]
    assert places[0] == str(Path("parts/gear.dxf"))
    assert places[1].endswith(", profile 1")


def test_an_answer_without_matches_says_so(plate, tmp_path):
    """On a page as on a sheet."""
    assert "No part was found." in page(tmp_path, plate, [], "query.dxf")
    write_sheet(tmp_path / "answer.png", plate, [])
    assert (tmp_path / "answer.png").exists()


def test_a_sheet_grows_by_rows_of_four(plate, matches, tmp_path):
    """Query and four matches are two rows, query and three are one."""
    heights = []
    for count in (3, 4):
        write_sheet(tmp_path / "answer.png", plate, matches[:count], "query.dxf")
        heights.append(matplotlib.image.imread(tmp_path / "answer.png").shape[0])
    assert heights[1] - heights[0] > 400


def test_another_suffix_is_refused_by_naming_the_known_ones(plate, matches, tmp_path):
    """And nothing is written."""
    with pytest.raises(MashapeError, match=r"answer\.pdf.*\.html or \.png"):
        write_sheet(tmp_path / "answer.pdf", plate, matches)
    assert list(tmp_path.iterdir()) == []


def test_hits_that_were_compared_are_laid_over_the_query(plate, tmp_path):
    """The tile says what the hit is and how far it is off, and shows what differs."""
    relation = Relation(Kind.SCALED, 25.4, False, 0.25, 0.031, 0.9, 0.1, (1.0, 0.0, 0.0, 1.0, 2.0, 0.0))
    matches = [
        Match(1, Path("a.dxf"), 0, 0.5, plate, 50.0, relation=relation),
        Match(2, Path("b.dxf"), 0, 0.6, plate, 50.0, unverified="b.dxf: gone"),
    ]
    text = page(tmp_path, plate, matches, "query.dxf")
    shown = Reader(text)
    assert shown.of("finding") == ["scaled by 25.4 (inch/mm?)", "not compared"]
    assert shown.of("facts")[1] == "off by 0.25 mm · 3.10% of the area differs"
    assert text.count('fill="var(--wrong)"') == 1
    write_sheet(tmp_path / "sheet.png", plate, matches, "query.dxf")
    assert (tmp_path / "sheet.png").stat().st_size > 1000


def test_a_portion_is_drawn_on_the_hit(tmp_path, plate):
    """In the colour of the query's frame, thick, with how much of the query it is."""
    stretch = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)])
    match = Match(1, Path("a.dxf"), 0, 0.5, plate, 12.0, portion=Portion(0.42, Similarity.of(), (stretch,)))
    text = page(tmp_path, plate, [match])
    assert "contains 42% of the query" in text
    assert "that portion is drawn in colour" in text
    assert ACCENT in text
