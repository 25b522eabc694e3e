"""The door itself: whether the kernel can be imported here, and what to do if not."""

from mashape_cad.errors import KernelUnavailableError

__all__ = ["open_door"]


def open_door() -> None:
    """Import the kernel for the first time.

    Raises
    ------
    KernelUnavailableError
        If it cannot be imported; the message says in one line what to install.
    """
    try:
        import OCP.gp  # noqa: F401  (imported for whether it can be)
    except ImportError as error:
        raise KernelUnavailableError(_remedy(error)) from error


def _remedy(error: ImportError) -> str:
    """Return one line: what the system said, and what to install."""
    reason = " ".join(str(error).split())
    if (error.name or "").partition(".")[0] == "OCP" and isinstance(error, ModuleNotFoundError):
        return f"the geometry kernel is missing ({reason}); install it with: pip install cadquery"
    if "libGL" in reason:
        return (
            f"the geometry kernel needs the system library libGL ({reason}); "
            "on Debian or Ubuntu: apt-get install --no-install-recommends libgl1; "
            "on Fedora: dnf install mesa-libGL; on Alpine or Arch: the package mesa"
        )
    return f"the geometry kernel cannot be loaded ({reason}); install the library it names, or reinstall cadquery"
