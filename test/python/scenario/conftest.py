"""A small correct scenario as plain values, and helpers around it."""

import copy

import pytest

from deformable_manipulation.scenario import ScenarioError, scenario_from_mapping

CORRECT = {
    "name": "small",
    "object": {
        "type": "rod",
        "length": 2.0,
        "radius": 0.01,
        "density": 1000.0,
        "segments": 10,
        "young_modulus": 1.0e7,
        "torsion_modulus": 4.0e6,
        "pose": {"position": [0.0, 0.0, 1.0], "orientation": [0.0, 0.0, 0.6, 0.8]},
    },
    "agents": {
        "hand": {"particle": 0, "role": "leader", "start": [0.0, 0.0, 1.0]},
        "helper": {"particle": 9, "role": "assistant", "start": [0.0, 1.5, 1.0]},
    },
    "obstacles": [{"name": "block", "polygon": [[2, 0], [3, 0], [3, 1], [2, 1]], "plane": "xz"}],
    "leader": {
        "waypoints": [
            {"time": 0.0, "position": [0.0, 0.0, 0.0]},
            {"time": 2.0, "position": [0.0, 0.1, 0.0]},
        ]
    },
    "controller": {"rate": 50.0, "collision": {"offset": 0.05}},
    "simulation": {"duration": 5.0, "time_step": 0.01},
}


FABRIC = dict(
    CORRECT,
    object={
        "type": "fabric",
        "size": [1.0, 1.0],
        "resolution": 4,
        "density": 0.5,
        "thickness": 0.002,
        "stretching_compliance": 1e-5,
        "bending_compliance": 1e4,
        "pose": {"position": [0.0, 0.0, 1.0]},
    },
    agents={
        "hand": {"particle": 0, "role": "leader", "start": [0.0, 0.0, 1.0]},
        "helper": {"particle": 4, "role": "assistant", "start": [0.9, 0.0, 1.0]},
    },
)


@pytest.fixture
def mapping():
    """A correct scenario as plain values, free to change."""
    return copy.deepcopy(CORRECT)


@pytest.fixture
def fabric_mapping():
    """A correct scenario of a fabric of 5 x 5 particles as plain values, free to change."""
    return copy.deepcopy(FABRIC)


@pytest.fixture(scope="session")
def correct_fabric():
    """The correct scenario of a fabric, not to be changed."""
    return FABRIC


@pytest.fixture(scope="session")
def correct():
    """The correct scenario, not to be changed (for property tests, which share fixtures)."""
    return CORRECT


def with_value(mapping, key, value):
    """Set the value at a key path such as "leader.waypoints.0.time"; returns the mapping."""
    *parents, last = key.split(".")
    container = mapping
    for parent in parents:
        if isinstance(container, dict):
            container = container.setdefault(parent, {})
        else:
            container = container[int(parent)]
    container[int(last) if isinstance(container, list) else last] = value
    return mapping


@pytest.fixture
def change():
    """The function that sets a value at a key path of a mapping."""
    return with_value


@pytest.fixture
def problems_of(tmp_path):
    """Function: the problems of a mapping by key; the messages of one key joined."""

    def problems(mapping):
        with pytest.raises(ScenarioError) as caught:
            scenario_from_mapping(mapping, tmp_path)
        found = {}
        for problem in caught.value.problems:
            text = "{} {}".format(problem.value, problem.message)
            found[problem.key] = (found[problem.key] + "\n" if problem.key in found else "") + text
        return found

    return problems
