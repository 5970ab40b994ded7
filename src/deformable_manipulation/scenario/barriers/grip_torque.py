"""The barrier on the torque at the grips."""

from deformable_manipulation.scenario.barriers.loads import (
    demand_rod,
    limit_parameter,
    load_barrier,
    orientations_of_grips,
    per_axis_parameter,
)

_MAX_TORQUE = "Greatest torque about a held point that the object exerts on its agent."

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
    check=demand_rod("grip_torque", "the vertices of a fabric exert no torque"),
    unit="N m",
    needs_wrenches=True,
)
