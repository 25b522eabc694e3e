"""What the kernel raises, as one exception of ours: `ShapeError`."""

from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["ShapeError", "kernel_failures_told"]


class ShapeError(ValueError):
    """The kernel could not do what it was asked for; the message says why."""


@contextmanager
def kernel_failures_told() -> Iterator[None]:
    """Turn the kernel's exceptions into `ShapeError`.

    In Python the kernel's exceptions share no base class (not even its own `Standard_Failure`): they are told by where
    they are defined. Failures of the C++ library arrive as `RuntimeError` and `MemoryError`.
    """
    try:
        yield
    except Exception as error:
        from_kernel = type(error).__module__.partition(".")[0] == "OCP"
        if not from_kernel and not isinstance(error, RuntimeError | MemoryError):
            raise
        said = " ".join(str(error).split())
        raise ShapeError(f"the kernel fails ({type(error).__name__}{': ' + said if said else ''})") from error
