"""How a scan gets on."""

import io
from pathlib import Path

from stand_ins import profile_record, sidecar

from mashape_cad.library.freshness import Status
from mashape_cad.library.record import Failure, Source
from mashape_cad.scanning import FileScanned, ScanStarted, ScanSummary
from mashape_cad.views.progress import scan_progress, summary_sentence

GOOD = FileScanned(Path("a.dxf"), Status.NEW, sidecar(Source("a.dxf", 1, 1, None), profile_record(1)))
BAD = FileScanned(Path("[bold] b.dxf"), Status.FAILED, failure=Failure("timeout", "took longer than 3 s"))


def _shown(*events, bar):
    stream = io.StringIO()
    stream.isatty = lambda: bar
    with scan_progress(stream, bar=bar) as tell:
        for event in events:
            tell(event)
    return stream.getvalue()


def test_without_a_terminal_only_failures_are_told():
    """A line each, as it is, however long."""
    assert _shown(ScanStarted(2), GOOD, BAD, bar=False) == "failed: [bold] b.dxf: took longer than 3 s\n"


def test_a_message_that_names_its_file_is_not_doubled():
    """A sidecar's path says which file it is."""
    event = FileScanned(
        Path("c.dxf"), Status.FAILED, failure=Failure("sidecar", "c.dxf.mashape.json: format version 2")
    )
    assert _shown(event, bar=False) == "failed: c.dxf.mashape.json: format version 2\n"


def test_on_a_terminal_it_counts(monkeypatch):
    """Files done, of how many, and failures."""
    monkeypatch.setenv("TERM", "xterm")
    shown = _shown(ScanStarted(2), GOOD, BAD, bar=True)
    assert "2/2" in shown
    assert "1 failed" in shown


def test_no_color_is_honoured(monkeypatch):
    """No escape sequence sets a colour."""
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[3" not in _shown(ScanStarted(2), GOOD, BAD, bar=True)


def test_summary_is_one_sentence():
    """Only what there is is counted."""
    summary = ScanSummary(3, 0, 2, 1, 1, 17, 4.21)
    told = "6 files: 3 new, 2 unchanged, 1 failed (1 of the unchanged had failed: --retry-failed); 17 profiles, 4.2 s"
    assert summary_sentence(summary) == told
