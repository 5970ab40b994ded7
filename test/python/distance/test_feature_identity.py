"""The identity of a feature is that of its obstacle and element."""

import mesh_reference as reference
import numpy as np
from mesh_reference import fields

from deformable_manipulation import _distance


def cycles(obstacles, states):
    """Fields of Distances of one state after the other."""
    calculator = _distance.MinimumDistance(obstacles, 0.0, 0.05)
    for state in states:
        copies = np.stack((state, state + 0.01))
        yield fields(calculator, copies)


def own(result, name):
    """A field of the features of copy 0."""
    return result[name][: result["offsets"][1]]


def test_a_rope_along_an_edge_has_a_number_per_segment():
    obstacle = _distance.MeshObstacle(*reference.cube())
    line = np.linspace([0.0, 0.0, 1.02], [1.0, 0.0, 1.02], 11)
    waves = (line + [0, 0.01 * np.sin(s), 0.01 * np.cos(s)] for s in range(10))
    for result in cycles([obstacle], waves):
        assert own(result, "identity").tolist() == own(result, "vertices")[:, 0].tolist()
        assert len(own(result, "identity")) == 10


def test_several_obstacles_have_numbers_of_their_own():
    obstacles = [_distance.MeshObstacle(*reference.cube()) for _ in range(2)]
    line = np.linspace([0.0, 0.5, 1.02], [1.0, 0.5, 1.02], 5)
    for result in cycles(obstacles, [line, line + 0.001]):
        assert len(set(own(result, "identity"))) == len(own(result, "identity"))
