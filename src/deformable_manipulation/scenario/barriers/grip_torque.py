"""The barrier on the torque at the grips."""

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.scenario.barriers.loads import (
    limit_parameter,
    load_barrier,
    orientations_of_grips,
    per_axis_parameter,
)

_MAX_TORQUE = "Greatest torque about a held point that the object exerts on its agent."


def _check(report, spec, agents, _controller) -> None:
    if not isinstance(spec, RodSpec) and not any(agent.further_particles for agent in agents):
        report.add(
            ("controller", "grip_torque"),
            "is for ropes and rods, and for grips that hold several vertices of a fabric "
            "(further_particles): a single one exerts no torque. Remove the section",
            spec.type,
        )


BARRIER = load_barrier(
    "grip_torque",
    {
        "max_torque": limit_parameter("N m", _MAX_TORQUE),
        "max_torque_per_axis": per_axis_parameter("N m", "torque"),
    },
    "Keeps the torque at each agent's grip below what wrist and grip bear.",
    rank=54,
    margin="grip torque margin",
    missed="the torque at a grip is too large",
    derive=orientations_of_grips,
    check=_check,
    unit="N m",
    needs_wrenches=True,
)
