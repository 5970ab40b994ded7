"""What a case of the validation hands back: compared numbers and curves."""

from dataclasses import dataclass, field
from typing import List, Optional, Sequence

import numpy as np


@dataclass(frozen=True)
class Check:
    """One compared quantity; a row of the table.

    ``theory`` is None if the measured number is itself an error. ``error`` and ``tolerance``
    have the unit ``error_unit``; a case passes while the error is at most the tolerance.
    """

    quantity: str
    theory: Optional[float]
    measured: float
    unit: str
    error: float
    tolerance: float
    error_unit: str

    @property
    def passed(self) -> bool:
        """False also where a number is not finite."""
        return bool(np.isfinite(self.measured) and self.error <= self.tolerance)


def relative_check(
    quantity: str, theory: float, measured: float, unit: str, tolerance: float
) -> Check:
    """Compare a number with theory; the tolerance is in percent of the theory."""
    error = 100.0 * abs(measured / theory - 1.0)
    return Check(quantity, float(theory), float(measured), unit, float(error), tolerance, "%")


def ratio_check(quantity: str, reachable: float, measured: float, unit: str, most: float) -> Check:
    """Compare an error with the one that the discretisation allows; the tolerance is a multiple."""
    error = measured / reachable
    return Check(quantity, float(reachable), float(measured), unit, float(error), most, "times")


def error_check(quantity: str, measured: float, unit: str, tolerance: float) -> Check:
    """Hold a number that should be zero below a tolerance of the same unit."""
    error = abs(measured)
    return Check(quantity, None, float(measured), unit, float(error), tolerance, unit)


@dataclass(frozen=True)
class Curve:
    """Points x and y of a line; theory is drawn in black, simulation with marks."""

    label: str
    x: Sequence[float]
    y: Sequence[float]
    theory: bool = False


@dataclass(frozen=True)
class Panel:
    """Curves over common axes."""

    title: str
    x_label: str
    y_label: str
    curves: Sequence[Curve]
    x_scale: str = "linear"
    y_scale: str = "linear"
    equal: bool = False  # both axes in the same scale: shapes
    limit: Optional[float] = None  # a tolerance, drawn as a level line


@dataclass(frozen=True)
class CaseResult:
    """A case: its title, how it was done, all comparisons, and the panels of its figure."""

    title: str
    method: str
    checks: List[Check]
    panels: List[Panel] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether every comparison is within its tolerance."""
        return all(check.passed for check in self.checks)


def percent_of(deviation: np.ndarray, length: float) -> float:
    """Largest norm of the rows (n, d) [m] of a deviation, in percent of a length [m]."""
    return float(100.0 * np.linalg.norm(deviation, axis=-1).max() / length)


def refined(tolerance: float, segments: int) -> float:
    """Shrink a tolerance at 28 segments as the square of the segment length, with 20 % room."""
    coarsest = 28
    return tolerance if segments <= coarsest else 1.2 * tolerance * (coarsest / segments) ** 2
