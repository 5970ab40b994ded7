"""Copies of an object, and the time that they take."""

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.benchmarks.harness import Effort, measure
from deformable_manipulation.benchmarks.table import Column

DISPLACEMENT = 0.1  # m, of the held point in the copies
COLUMNS = (
    Column("copies", "copies", "d"),  # the object among them
    Column("median_us", "median [µs]", ".2f"),
    Column("minimum_us", "minimum [µs]", ".2f"),
    Column("per_copy_us", "median per copy [µs]", ".3f"),
)


def add_copies(body: _pbd.Body, particle: int, copies: int) -> None:
    """Add copies with a held particle displaced, until the object and they are ``copies``."""
    for index in range(copies - 1):
        angle = 2.0 * np.pi * index / max(1, copies - 1)
        body.add_copy(particle, (0.0, DISPLACEMENT * np.cos(angle), DISPLACEMENT * np.sin(angle)))


def time_substep(body: _pbd.Body, substep: float, call: int, effort: Effort) -> dict:
    """Cells of the columns, for substeps [s] of a body, ``call`` of them in each call of step."""
    copies = 1 + len(body.copy_ids)
    timing = measure(
        lambda state: state.step(call * substep, call), prepare=body.clone, effort=effort
    ).per(call)
    return {
        "copies": copies,
        "median_us": 1e6 * timing.median,
        "minimum_us": 1e6 * timing.minimum,
        "per_copy_us": 1e6 * timing.median / copies,
        "quartiles_us": [1e6 * timing.quantile(0.25), 1e6 * timing.quantile(0.75)],
        "substeps": timing.inner,
        "repetitions": len(timing.seconds),
    }
