"""The rod of this package, for the comparison with others."""

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.benchmarks.copies import add_copies
from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase
from deformable_manipulation.benchmarks.rod_model import RodModel
from deformable_manipulation.validation import rod as validation_rod

SUBSTEP = {"direct": 0.005, "gauss_seidel": 0.0005}  # s; the paper takes 20 or more per 10 ms


def make_rod(case: RodCase, solver: str, stretch: str = "zero") -> _pbd.Rod:
    """The undeformed rod of a case, along x from the origin, held nowhere."""
    return validation_rod.make_rod(
        case,
        case.segments,
        gravity=(0.0, 0.0, -case.gravity),
        stretch=stretch,
        damping=case.damping,
        solver=solver,
    )


class PackageRod(RodModel):
    """The rod itself is what is looked at; its copies are carried along."""

    def __init__(self, case: RodCase, solver: str, stretch: str = "zero", copies: int = 1):
        self.time_step = SUBSTEP[solver]
        self.settings = f"{solver}, stretch {stretch}"
        self._last = case.segments - 1
        self._rod = make_rod(case, solver, stretch)
        self._rope = case.load == ROPE
        self._grip = np.array(self._rod.positions()[0])
        if self._rope:
            self._rod.hold(0, "pinned")
            self._rod.hold(self._last, "pinned")
            self.overhang = 0.5 * case.segment_length
            self._arcs = case.segment_length * np.arange(case.segments)
        else:
            self._rod.hold(0, "clamped")
            self._arcs = case.segment_length * (np.arange(case.segments) + 0.5)
        self.free_length = float(self._arcs[-1])
        add_copies(self._rod, self._last if self._rope else 0, copies)

    def advance(self, count: int) -> None:
        self._rod.step(count * self.time_step, count)

    def place_end(self, x: float, velocity: float) -> None:
        # Its place follows from its velocity, step by step.
        self._rod.set_velocity(self._last, (velocity, 0.0, 0.0))

    def points(self) -> np.ndarray:
        points = self._rod.positions() if self._rope else self._rod.points()[0][1:]
        return points[:, ::2] - self._grip[::2]

    def arc_lengths(self) -> np.ndarray:
        return self._arcs
