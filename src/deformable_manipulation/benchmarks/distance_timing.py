"""How calls for distances are timed."""

import itertools
import os
import time
from pathlib import Path
from typing import Any, Callable, Tuple

import numpy as np

from deformable_manipulation import _distance
from deformable_manipulation.benchmarks.harness import QUICK, measure
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column

SLOW = 1.0  # s, of a call: longer ones are measured a few times only
TIMES = (
    Column("median_us", "median [µs]", ".1f"),
    Column("minimum_us", "minimum [µs]", ".1f"),
)


def own_calls(obstacle, triangles) -> list:
    """This package's computations, by name. Without a band copy 0 has hardly any other feature."""
    found = []
    for name, band in (("minimum", 0.0), ("features", 0.1)):
        calculator = _distance.MinimumDistance([obstacle], 0.0, band)

        def call(points, calculator=calculator):
            return calculator.compute(points, triangles).minimum

        found.append((f"deformable_manipulation, {name}", call))
    return found


def timed(call: Callable, body, request: Request) -> dict:
    """Times of calls with one state of the object after the other, and its lowest distance."""
    lowest = float(np.min(call(body.states[0])))
    started = time.perf_counter()
    call(body.states[1])
    slow = time.perf_counter() - started > SLOW
    following = itertools.cycle(body.states)
    timing = measure(lambda _: call(next(following)), effort=QUICK if slow else request.effort)
    return {
        "median_us": 1e6 * timing.median,
        "minimum_us": 1e6 * timing.minimum,
        "distance": lowest,
    }


def built(make: Callable[..., Any], *arguments: Any) -> Tuple[Any, dict]:
    """What a function makes, how long that takes, and the memory it needs."""
    before, started = _resident(), time.perf_counter()
    obstacle = make(*arguments)
    elapsed = time.perf_counter() - started
    return obstacle, {"build_ms": 1e3 * elapsed, "memory_mb": 1e-6 * (_resident() - before)}


def _resident() -> int:
    """Memory of this process [bytes]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
