"""How long it takes from a new cloud of a camera to the distances from it."""

import time
from types import SimpleNamespace
from typing import Any, Callable, Dict, List

import numpy as np

from deformable_manipulation import _distance
from deformable_manipulation.benchmarks.distance_cases import fabric, rope
from deformable_manipulation.benchmarks.distance_seen import COPIES, HEIGHTS, cloud_points
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.cloud_formats.point_cloud2 import columns

POINTS, QUICK_POINTS = 300_000, 30_000
REPETITIONS, QUICK_REPETITIONS = 21, 3
REACH = 0.02  # m, of what is left out around the object

COLUMNS = (
    Column("points", "points"),
    Column("case", "object"),
    Column("decode_ms", "decoded [ms]", ".1f"),
    Column("mark_ms", "own points left out [ms]", ".1f"),
    Column("build_ms", "tree built [ms]", ".1f"),
    Column("warm_ms", "made ready [ms]", ".1f"),
    Column("first_ms", "first call [ms]", ".2f"),
    Column("cold_ms", "first call, not made ready [ms]", ".2f"),
    Column("usual_ms", "other calls [ms]", ".2f"),
)
NOTES = (
    "medians; all but the last three columns go on in a thread beside the control cycle, which "
    "does not wait for them",
    "a call: minima and features of {} copies".format(COPIES),
)


def measure_new_clouds(request: Request) -> List[Table]:
    """Time each step on the way of a cloud."""
    table = Table("new_cloud", "A new cloud, until it is used", COLUMNS, notes=list(NOTES))
    count = QUICK_POINTS if request.quick else POINTS
    for case, body in (
        ("rope", rope(COPIES, height=HEIGHTS["near"])),
        ("fabric", fabric(COPIES, height=HEIGHTS["near"])),
    ):
        request.say(f"{case}, new clouds")
        table.rows.append({"points": count, "case": case, **_steps(count, body, request)})
    return [table]


def _steps(count: int, body: Any, request: Request) -> Dict[str, float]:
    message, elements = _message(cloud_points(count)), _elements(body)
    reaches = np.full(len(elements), REACH)
    minimum = _distance.MinimumDistance([_distance.CloudObstacle([], 0.0)], 0.0, 0.1)
    taken: Dict[str, List[float]] = {}

    def step(name: str, call: Callable[..., Any], *arguments: Any) -> Any:
        started = time.perf_counter()
        result = call(*arguments)
        taken.setdefault(name, []).append(1e3 * (time.perf_counter() - started))
        return result

    for _ in range(QUICK_REPETITIONS if request.quick else REPETITIONS):
        points = step("decode_ms", columns, message)
        own = step("mark_ms", _distance.near_elements, points, elements, reaches)
        cloud = step("build_ms", _distance.PointCloud, points[~own])
        obstacle = _distance.CloudObstacle(cloud, 0.0)
        step("warm_ms", obstacle.warm, body.states[0], body.triangles)
        for kind, new in (("first_ms", obstacle), ("cold_ms", _distance.CloudObstacle(cloud, 0.0))):
            minimum.replace(0, new)
            step(kind, minimum.compute, body.states[1], body.triangles)
        for state in body.states[2:]:
            step("usual_ms", minimum.compute, state, body.triangles)
    return {name: float(np.median(times)) for name, times in taken.items()}


def _message(points: np.ndarray) -> Any:
    """As a driver publishes them: x, y, z and a gap."""
    records = np.zeros((len(points), 4), dtype="<f4")
    records[:, :3] = points
    fields = [SimpleNamespace(name=axis, offset=4 * k, datatype=7) for k, axis in enumerate("xyz")]
    return SimpleNamespace(
        height=1,
        width=len(points),
        fields=fields,
        is_bigendian=False,
        point_step=16,
        row_step=16 * len(points),
        data=records.tobytes(),
    )


def _elements(body: Any) -> np.ndarray:
    """Triangles, or segments as start, end, end (E, 3, 3) [m], of the object itself."""
    points = body.states[0, 0]
    if body.triangles is not None:
        return points[body.triangles]
    return np.stack((points[:-1], points[1:], points[1:]), axis=1)
