"""Obstacles as a robot sees them, and those that are given by numbers: one hill in all of them."""

from typing import Any, Callable, Iterator, List, Sequence, Tuple

import numpy as np

from deformable_manipulation import _distance
from deformable_manipulation.benchmarks.distance_cases import fabric, rope
from deformable_manipulation.benchmarks.distance_rivals import SciPyTree
from deformable_manipulation.benchmarks.distance_timing import TIMES, built, own_calls, timed
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table

COPIES = 13
POINTS = (300_000, 10_000_000)
QUICK_POINTS = (30_000,)
SPACING = 0.02  # m, of cells and of the field
HALF_WIDTH = 1.5  # m, of the ground to all sides
HEIGHTS = {"near": 0.45, "far": 3.0}  # m, of the object over the ground

COLUMNS = (
    Column("obstacle", "obstacle"),
    Column("case", "object"),
    Column("what", "what is called"),
    *TIMES,
    Column("distance", "lowest distance [m]", ".6f"),
)
BUILD_COLUMNS = (
    Column("obstacle", "obstacle"),
    Column("build_ms", "built in [ms]", ".1f"),
    Column("memory_mb", "memory [MB]", ".0f"),
)
NOTES = (
    "a hill of 0.3 m on 3 m x 3 m of ground, with noise of 2 mm: a rope of 44 segments and a "
    "fabric of 392 triangles, each with {} copies, one thread".format(COPIES),
    "SciPy's cKDTree is asked for the ends of the segments and the corners of the triangles alone",
)


def ground(places: np.ndarray) -> np.ndarray:
    """Heights [m] of the hill at places (..., 2)."""
    return 0.3 * np.exp(-4.0 * np.sum(places**2, axis=-1))


def cloud_points(count: int) -> np.ndarray:
    """As of a depth camera (N, 3) [m]."""
    rng = np.random.default_rng(1)
    places = rng.uniform(-HALF_WIDTH, HALF_WIDTH, (count, 2))
    heights = ground(places) + 0.002 * rng.normal(size=count)
    return np.column_stack((places, heights)).astype(np.float32)


def measure_seen(request: Request) -> List[Table]:
    """Time the kinds of obstacles that a robot makes of what it sees."""
    times = Table("seen", "Obstacles as a robot sees them", COLUMNS, notes=list(NOTES))
    builds = Table("seen_build", "Making them obstacles", BUILD_COLUMNS)
    for name, make, arguments, rival in _obstacles(request):
        request.say(f"{name}, build")
        obstacle, row = built(make, *arguments)
        builds.rows.append({"obstacle": name, **row})
        for case, body in _bodies():
            candidates = own_calls(obstacle, body.triangles)
            candidates += [(SciPyTree.name, rival)] if rival else []
            for what, call in candidates:
                request.say(f"{name}, {case}, {what}")
                labels = {"obstacle": name, "case": case, "what": what}
                times.rows.append({**labels, **timed(call, body, request)})
    return [times, builds]


def _bodies() -> Iterator[Tuple[str, Any]]:
    for place, height in HEIGHTS.items():
        yield f"rope, {place}", rope(COPIES, height=height)
        yield f"fabric, {place}", fabric(COPIES, height=height)


def _obstacles(request: Request) -> Iterator[Tuple[str, Callable[..., Any], Sequence[Any], Any]]:
    """Names, what makes the obstacle of which arguments, and another library's call or None."""
    for count in QUICK_POINTS if request.quick else POINTS:
        points = cloud_points(count)
        yield f"cloud, {count} points", _cloud, [points], SciPyTree(points)
    cells = _cells()
    yield f"voxels, {len(cells)} cells", _distance.MeshObstacle.of_cells, [cells, SPACING], None
    values, origin = _values()
    arguments = [values, origin, (SPACING,) * 3, True]
    yield f"field, {values.size} values", _distance.FieldObstacle, arguments, None
    yield "box", _distance.PrimitiveObstacle.box, [(1.0, 1.0, 0.6)], None
    yield "cylinder", _distance.PrimitiveObstacle.cylinder, [0.5, 0.6], None


def _cloud(points: np.ndarray) -> Any:
    return _distance.CloudObstacle(_distance.PointCloud(points), 0.0)


def _places() -> np.ndarray:
    line = np.arange(-HALF_WIDTH, HALF_WIDTH, SPACING)
    return np.stack(np.meshgrid(line, line, indexing="ij"), axis=-1)


def _cells() -> np.ndarray:
    """The ground as cells (N, 3), five deep."""
    columns = np.round(_places() / SPACING).astype(np.int32)
    tops = np.floor(ground(_places()) / SPACING).astype(np.int32)[..., None]
    layers = [np.concatenate((columns, tops - k), axis=-1) for k in range(5)]
    return np.concatenate(layers).reshape(-1, 3)


def _values() -> Tuple[np.ndarray, Tuple[float, float, float]]:
    """Lower bounds of the distance from the ground on a grid, and the grid's origin."""
    heights = np.arange(-0.2, 1.0, SPACING)
    return 0.6 * (heights - ground(_places())[..., None]), (-HALF_WIDTH, -HALF_WIDTH, -0.2)
