"""The barrier that keeps each assistant's held point where it may be: table, walls, cabinet."""

import math
from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    LARGEST_COORDINATE,
    Array,
    Items,
    Node,
    Number,
    Section,
    Slopes,
    position,
)
from deformable_manipulation.scenario.barriers.kind import BarrierKind, margin_parameter

Vector = Tuple[float, float, float]
_EVERYWHERE = (LARGEST_COORDINATE,) * 3
_NOWHERE = (-LARGEST_COORDINATE,) * 3
_SHORTEST_NORMAL = 1e-6


class Direction(Array):
    """A vector [x, y, z] other than zero; its length does not matter."""

    def __init__(self):
        super().__init__(3, Number("1", at_least=-1e6, at_most=1e6), "[x, y, z]")
        self.range = "not zero"

    def __call__(self, node: Node) -> Vector:
        direction = super().__call__(node)
        if math.hypot(*direction) < _SHORTEST_NORMAL:
            node.fail("must be a direction, and not zero")
        return direction


@dataclass(frozen=True)
class PlaneSpec:
    """A plane that the held points stay on one side of."""

    point: Vector = parameter(position(), "A point of the plane.", native=True)
    normal: Vector = parameter(
        Direction(), "Points to the side on which the held points stay.", native=True
    )


@dataclass(frozen=True)
class SphereSpec:
    """A sphere that the held points stay out of."""

    center: Vector = parameter(position(), "Centre of the sphere.", native=True)
    radius: float = parameter(
        Number("m", above=0.0, at_most=LARGEST_COORDINATE), "Its radius.", native=True
    )


PLANE = Section(PlaneSpec)
SPHERE = Section(SphereSpec)


@dataclass(frozen=True)
class WorkspaceBarrierSpec:
    """Parameters of the workspace barrier."""

    lower: Vector = parameter(
        position(),
        "Lower corner of a box along the axes of the fixed frame. -1e6 is no limit.",
        default=_NOWHERE,
        native=True,
    )
    upper: Vector = parameter(
        position(),
        "Upper corner of the box. 1e6 is no limit.",
        default=_EVERYWHERE,
        allowed="above `lower` in each axis",
        native=True,
    )
    planes: Tuple[PlaneSpec, ...] = parameter(
        Items(PLANE),
        "Planes such as a table or a wall, each `{point: [x, y, z], normal: [x, y, z]}`; the "
        "normal points to the side on which the held points stay.",
        default=(),
        native=True,
    )
    spheres: Tuple[SphereSpec, ...] = parameter(
        Items(SPHERE),
        "Spheres to stay out of, each `{center: [x, y, z], radius: r}`.",
        default=(),
        native=True,
    )
    margin: float = margin_parameter(
        "The rows stay this much within the limits. Use half the size of your gripper.",
        default=0.0,
        live=None,
    )
    alpha: Tuple[float, float] = parameter(
        Slopes(),
        "How fast h may shrink, per metre left, and how fast a violation is corrected.",
        default=(1.0, 5.0),
        native=True,
    )


def _lowest(workspace: WorkspaceBarrierSpec, point: Vector) -> float:
    """The least h [m] of a held point."""
    values = [x - low for x, low in zip(point, workspace.lower)]
    values += [high - x for x, high in zip(point, workspace.upper)]
    for plane in workspace.planes:
        along = sum(n * (x - p) for n, x, p in zip(plane.normal, point, plane.point))
        values.append(along / math.hypot(*plane.normal))
    values += [math.dist(point, sphere.center) - sphere.radius for sphere in workspace.spheres]
    return min(values)


def _check(report, spec, agents, controller) -> None:
    """The box has an inside, and the assistants start in their workspace."""
    workspace = controller.workspace
    path = ("controller", "workspace")
    if not all(low < high for low, high in zip(workspace.lower, workspace.upper)):
        report.add(
            path + ("upper",),
            "must be above controller.workspace.lower in each axis, {}".format(
                show(list(workspace.lower))
            ),
            show(list(workspace.upper)),
        )
        return
    for agent in agents:
        h = _lowest(workspace, agent.start) if agent.role == "assistant" else 0.0
        if h < 0.0:
            report.add(
                ("agents", agent.name, "start"),
                "is {:.4g} m outside controller.workspace; move it inside".format(-h),
                show(list(agent.start)),
            )


BARRIER = BarrierKind(
    name="workspace",
    spec=WorkspaceBarrierSpec,
    rank=20,
    meaning="Keeps each assistant's held point within a box, on one side of planes and out of "
    "spheres: a table, walls, a cabinet. See [workspace](barriers/workspace.md).",
    margin="workspace margin",
    missed="a grip is outside the workspace",
    default=None,
    check=_check,
)
