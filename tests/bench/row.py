"""One line of the benchmark: one way of computing on one shape."""

from dataclasses import dataclass, field

__all__ = ["Row"]


@dataclass(frozen=True, slots=True)
class Row:
    """What one way gave on one shape; errors are by the larger side of the shape.

    Attributes
    ----------
    shape, way, setting : str
    edges : int
        Of the shape.
    inputs : int
        Of what was handed over: edges, chords or points.
    parts_ms : dict
        CPU ms by part of the work, medians.
    error : float
        See `accuracy`; infinite where junctions should have been found and were not.
    radius_error : float
        Largest difference of a radius and the kernel's distance.
    junctions, expected : int
        Found, and exact ones.
    failure : str
        Why there is nothing of that.
    """

    shape: str
    way: str
    setting: str
    edges: int
    inputs: int
    parts_ms: dict[str, float] = field(default_factory=dict)
    error: float = float("nan")
    radius_error: float = float("nan")
    junctions: int = 0
    expected: int = 0
    failure: str = ""

    @property
    def cpu_ms(self) -> float:
        """The whole time."""
        return sum(self.parts_ms.values()) if self.parts_ms else float("nan")
