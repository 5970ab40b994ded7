"""What another engine can simulate: mistakes of ``knowledge.world``."""

from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Report
from deformable_manipulation.scenario.knowledge import MUJOCO, KnowledgeSpec

# The engine needs two seconds to prepare so many, and its time grows with the cube of the pieces.
MOST_PIECES = 300
MOST_VERTICES = 2000


def check_world(report: Report, spec: ObjectSpec, knowledge: KnowledgeSpec) -> None:
    """The engine has such an object, and takes no more than hours for a run of it."""
    if knowledge.world != MUJOCO:
        return
    if isinstance(spec, RodSpec):
        _check_cable(report, spec, knowledge.refinement)
    elif isinstance(spec, FabricSpec):
        _check_sheet(report, spec)


def _check_cable(report: Report, rod: RodSpec, refinement: int) -> None:
    pieces = refinement * rod.segments
    if pieces > MOST_PIECES:
        report.add(
            ("knowledge", "refinement"),
            "makes {} pieces of the {} segments, but the world mujoco has at most {}; lower it, or "
            "object.segments".format(pieces, rod.segments, MOST_PIECES),
            show(refinement),
        )
    if rod.drag_coefficient > 0.0:
        report.add(
            ("object", "drag_coefficient"),
            "must be 0 in the world mujoco, which has no air drag of rods",
            show(rod.drag_coefficient),
        )
    if rod.stretch != "zero":
        report.add(
            ("object", "stretch"),
            "must be zero in the world mujoco, whose rods do not stretch",
            show(rod.stretch),
        )
    if rod.natural_shape is not None:
        report.add(
            ("object", "natural_shape"),
            "must be left out in the world mujoco, whose rods are straight without load",
        )
    if not rod.has_equal_segments:
        report.add(
            ("object", "grips"),
            "must have no lengths in the world mujoco, whose grips hold whole pieces of the rod: "
            "leave grip_length out of the agents",
        )
    if rod.point_masses:
        report.add(
            ("object", "point_masses"),
            "must be left out in the world mujoco, whose rods carry no masses at points",
        )


def _check_sheet(report: Report, fabric: FabricSpec) -> None:
    if fabric.particles > MOST_VERTICES:
        report.add(
            ("object",),
            "has {} vertices, but the world mujoco has at most {}; use a coarser mesh".format(
                fabric.particles, MOST_VERTICES
            ),
        )
    for key in ("stretching_compliance", "bending_compliance"):
        if not getattr(fabric, key) > 0.0:
            report.add(
                ("object", key), "must be above 0 in the world mujoco", show(getattr(fabric, key))
            )
