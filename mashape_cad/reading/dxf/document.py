"""A DXF file as an ezdxf document: read, else recovered, else repaired and recovered; never a word on stderr."""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TypeVar

from ezdxf import recover
from ezdxf.audit import Auditor
from ezdxf.document import Drawing
from ezdxf.filemanagement import readfile

from mashape_cad.errors import UnreadableFileError
from mashape_cad.findings import Finding, Severity
from mashape_cad.reading.dxf.repair import Marked, with_decimal_points, with_subclass_markers

__all__ = ["Document", "listening", "load_document", "message_findings"]

_T = TypeVar("_T")

_BINARY = b"AutoCAD Binary DXF\r\n\x1a\x00"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_END = b"EOF"
# The end mark stands in the last line; some writers add remarks behind it.
_TAIL = 4096


@dataclass(frozen=True, slots=True)
class Document:
    """A drawing as ezdxf gives it, and what was the matter with the file."""

    drawing: Drawing
    findings: tuple[Finding, ...]


def load_document(path: Path) -> Document:
    """Load a DXF file of any version, text or binary.

    Raises
    ------
    UnreadableFileError
        If it is no DXF file, is cut off, or its structure is beyond repair.
    OSError
        If the file cannot be opened.
    """
    drawing, trouble = _attempt(lambda: _with_model_space(readfile(path)))
    if drawing is not None:
        return Document(drawing, ())
    data = path.read_bytes()
    _refuse_other_text(data)
    return _recovered(data, trouble.replace(str(path), path.name))


@contextmanager
def listening() -> Iterator[list[str]]:
    """Collect what ezdxf has to say, instead of letting it reach stderr."""
    messages: list[str] = []
    handler = _Collector(messages)
    logger = logging.getLogger("ezdxf")
    propagate, logger.propagate = logger.propagate, False
    logger.addHandler(handler)
    try:
        yield messages
    finally:
        logger.removeHandler(handler)
        logger.propagate = propagate


def message_findings(messages: list[str]) -> list[Finding]:
    """Sum up what ezdxf had to say."""
    if not messages:
        return []
    return [Finding("file-warning", Severity.INFO, f"ezdxf warns: {_one_line(messages[0])}", count=len(messages))]


class _Collector(logging.Handler):
    def __init__(self, messages: list[str]) -> None:
        super().__init__(logging.WARNING)
        self._messages = messages

    def emit(self, record: logging.LogRecord) -> None:
        self._messages.append(record.getMessage())


def _recovered(data: bytes, trouble: str) -> Document:
    """Recover what can be recovered."""
    findings = [Finding("file-recovered", Severity.REPAIRED, f"the file is damaged and was recovered: {trouble}")]
    is_text = not data.startswith(_BINARY)
    if is_text:
        data, commas = with_decimal_points(data)
        findings += _comma_finding(commas)
    result, _ = _attempt(lambda: _recover(data))
    if result is None and is_text:
        marked = with_subclass_markers(data)
        if marked.mended or marked.is_newer:
            result, _ = _attempt(lambda: _recover(marked.data))
            findings += _marker_findings(marked)
    if result is None:
        raise UnreadableFileError(f"not a sound DXF file: {trouble}; open it in a CAD program and save it again")
    drawing, auditor = result
    return Document(drawing, (*findings, *_audit_findings(auditor)))


def _recover(data: bytes) -> tuple[Drawing, Auditor]:
    drawing, auditor = recover.read(BytesIO(data))
    return _with_model_space(drawing), auditor


def _with_model_space(drawing: Drawing) -> Drawing:
    """Pass a drawing on, or raise if it has lost its model space."""
    drawing.modelspace()
    return drawing


def _comma_finding(commas: int) -> list[Finding]:
    if commas == 0:
        return []
    text = f"{commas} numbers with a decimal comma, read as if it were a point"
    return [Finding("file-decimal-comma", Severity.REPAIRED, text, count=commas)]


def _marker_findings(marked: Marked) -> list[Finding]:
    findings = []
    if marked.mended:
        text = f"{marked.mended} entities had no subclass markers, which have been added"
        findings.append(Finding("file-subclass-markers", Severity.REPAIRED, text, count=marked.mended))
    if marked.is_newer:
        text = "its entities are newer than the version in its header ($ACADVER), which was not believed"
        findings.append(Finding("file-version", Severity.REPAIRED, text))
    if marked.left_out:
        text = f"{marked.left_out} entities without subclass markers, of kinds that are not repaired"
        findings.append(Finding("entity-unsupported", Severity.LOST, text, count=marked.left_out))
    return findings


def _attempt(load: Callable[[], _T]) -> tuple[_T | None, str]:
    """Return what `load` gives, or None and why not."""
    try:
        return load(), ""
    except Exception as error:  # noqa: BLE001 a parser fed with damaged files raises whatever it happens to meet
        return None, _one_line(str(error) or type(error).__name__)


def _refuse_other_text(data: bytes) -> None:
    """Refuse what does not begin like a DXF file, and what has lost its end: it may be half a part."""
    if data.startswith(_BINARY):
        return
    first = data.removeprefix(_BYTE_ORDER_MARK).split(maxsplit=1)
    if not first or not first[0].isdigit():
        raise UnreadableFileError("not a DXF file: it does not begin with a group code; check what it really is")
    if _END not in data[-_TAIL:]:
        raise UnreadableFileError("cut off: its end mark (EOF) is missing; export or copy the file again")


def _audit_findings(auditor: Auditor) -> list[Finding]:
    errors = [entry.message for entry in auditor.errors]
    fixes = [entry.message for entry in auditor.fixes]
    findings = []
    if errors:
        text = f"damaged and not repaired: {_one_line(errors[0])}"
        findings.append(Finding("file-error", Severity.LOST, text, count=len(errors)))
    if fixes:
        text = f"damaged and repaired: {_one_line(fixes[0])}"
        findings.append(Finding("file-fixed", Severity.REPAIRED, text, count=len(fixes)))
    return findings


def _one_line(text: str) -> str:
    return " ".join(text.split())
