"""The barrier on the force at the grips."""

from deformable_manipulation.scenario.barriers.loads import (
    limit_parameter,
    load_barrier,
    orientations_of_grips,
    per_axis_parameter,
)

_MAX_FORCE = "Greatest force that the object exerts on any agent, its weight included."

BARRIER = load_barrier(
    "grip_force",
    {
        "max_force": limit_parameter("N", _MAX_FORCE),
        "max_force_per_axis": per_axis_parameter("N", "force"),
    },
    "Keeps the force at each agent's grip below what wrist and grip bear.",
    rank=52,
    margin="grip force margin",
    missed="the force at a grip is too large",
    derive=orientations_of_grips,
    unit="N",
    needs_wrenches=True,
)
