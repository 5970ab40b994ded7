"""The barrier that keeps a rod from being bent too sharply."""

from deformable_manipulation.scenario.barriers.loads import (
    demand_rod,
    limit_parameter,
    load_barrier,
)


def _derive(scenario):
    return {"joint_lengths": list(scenario.object.joint_lengths)}


BARRIER = load_barrier(
    "bending",
    {"min_radius": limit_parameter("m", "Least bend radius of the centre line, anywhere.")},
    "Keeps a rope or rod from being bent too sharply anywhere.",
    rank=50,
    margin="bending margin",
    missed="the object is bent too sharply",
    derive=_derive,
    check=demand_rod("bending", "a fabric folds, and has no bend radius"),
    unit="1/m",
)
