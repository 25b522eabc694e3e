"""Files are written whole or not at all: a reader sees the old content or the new one."""

import secrets
from pathlib import Path

__all__ = ["replace_file"]


def replace_file(path: Path, content: bytes) -> None:
    """Write a file, replacing what is there.

    Raises
    ------
    OSError
        If the folder cannot be written to; then the old file is as it was.
    """
    # In the same folder, because a rename is atomic only within one file system. The name is short, since the
    # sidecar's own may already be as long as the file system allows, and hidden, so that no scan looks at it.
    temporary = path.with_name(f".mashape-{secrets.token_hex(6)}.tmp")
    try:
        temporary.write_bytes(content)
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
