"""The barrier on the strain of edges."""

import numpy as np

from deformable_manipulation.scenario.barriers.loads import limit_parameter, load_barrier

_MAX_STRAIN = (
    "Greatest elongation of an edge over its unstretched length: of a side of a triangle, or of a "
    "segment."
)


def _derive(scenario):
    ends, lengths = scenario.object.edges()
    return {"edges": np.column_stack((ends, lengths))}


BARRIER = load_barrier(
    "strain",
    {"max_strain": limit_parameter("1", _MAX_STRAIN)},
    "Keeps each edge of a fabric's mesh, or segment of an extensible rod, from being stretched too "
    "far.",
    rank=58,
    margin="strain margin",
    missed="the object is strained too far",
    derive=_derive,
    unit="1",
)
