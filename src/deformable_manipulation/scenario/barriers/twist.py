"""The barrier on the twist along a rod."""

from deformable_manipulation.scenario.barriers.loads import (
    demand_rod,
    limit_parameter,
    load_barrier,
    weights_between_grips,
)


def _derive(scenario):
    stiffness = scenario.object.torsion_stiffness
    return {**weights_between_grips(scenario), "torsion_stiffness": stiffness}


BARRIER = load_barrier(
    "twist",
    {"max_twist": limit_parameter("rad/m", "Greatest twist per length anywhere, either way.")},
    "Keeps a rope or rod from being twisted too much anywhere.",
    rank=51,
    margin="twist margin",
    missed="the object is twisted too much",
    derive=_derive,
    check=demand_rod("twist", "a fabric has no twist"),
    unit="rad/m",
    needs_wrenches=True,
)
