"""An evaluation to look at: one self-contained HTML page, or a folder of PNGs."""

from pathlib import Path

from mashape_cad.evaluation.report import Report
from mashape_cad.views.colours import PAGE, PAPER
from mashape_cad.views.evaluation_sheets import sheets
from mashape_cad.views.evaluation_text import grids, headline
from mashape_cad.views.html import html
from mashape_cad.views.output import checked_suffix, folder_for, write
from mashape_cad.views.raster import png

__all__ = ["SUFFIXES", "write_page", "write_pictures"]

SUFFIXES = (".html",)


def write_page(out: Path, report: Report) -> None:
    """Write tables and sheets as one page.

    Raises
    ------
    PictureError
        If the suffix is not known or the file cannot be written.
    """
    checked_suffix(out, SUFFIXES)
    page = html("evaluation.html", headline=headline(report), grids=grids(report), sheets=tuple(sheets(report, PAGE)))
    write(out, page.encode())


def write_pictures(folder: Path, report: Report) -> tuple[Path, ...]:
    """Write each sheet as a PNG into a folder, which is made if there is none; return the files.

    Raises
    ------
    PictureError
        If the system refuses.
    """
    folder_for(folder)
    written = []
    for sheet in sheets(report, PAPER):
        written.append(folder / f"{sheet.name}.png")
        write(written[-1], png(sheet.drawing))
    return tuple(written)
