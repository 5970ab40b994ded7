"""The barrier on the tension along a rod."""

from deformable_manipulation.scenario.barriers.loads import (
    demand_rod,
    limit_parameter,
    load_barrier,
    weights_between_grips,
)

BARRIER = load_barrier(
    "tension",
    {"max_tension": limit_parameter("N", "Greatest tension anywhere in the rope or rod.")},
    "Keeps the tension anywhere in a rope or rod below what it bears.",
    rank=56,
    margin="tension margin",
    missed="the tension of the object is too large",
    derive=weights_between_grips,
    check=demand_rod("tension", "the tension of a fabric is its strain, see controller.strain"),
    unit="N",
    needs_wrenches=True,
)
