"""Properties that hold for every scenario: the round trip, and how broken files fail."""

import copy
import datetime
import math

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation.scenario import (
    ScenarioError,
    load_scenario,
    scenario_from_mapping,
    scenario_to_mapping,
    scenario_to_yaml,
)

positive = st.floats(1e-3, 1e9)
coordinate = st.floats(-100.0, 100.0)
point = st.lists(coordinate, min_size=3, max_size=3)
# At most 4.9 m apart: in a second the leader comes from each to any other.
waypoint = st.lists(st.floats(-1.4, 1.4), min_size=3, max_size=3)
slopes = st.lists(st.floats(0.01, 49.0), min_size=2, max_size=2)


@st.composite
def quaternions(draw):
    components = draw(
        st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda c: math.hypot(*c) > 0.1)
    )
    return [c / math.hypot(*components) for c in components]


@st.composite
def agent_sections(draw, length, segments):
    """Agents that start on a straight line, half a free length apart."""
    count = draw(st.integers(2, min(4, segments)))
    particles = draw(st.permutations(range(segments)).map(lambda p: p[:count]))
    origin = draw(point)
    sections = {}
    for index, particle in enumerate(particles):
        along = 0.5 * particle * length / segments
        section = {
            "particle": particle,
            "role": "leader" if index == 0 else "assistant",
            "start": [origin[0], origin[1] + along, origin[2]],
        }
        section.update(
            draw(
                st.fixed_dictionaries(
                    {},
                    optional={
                        "hold": st.sampled_from(["clamped", "pinned"]),
                        "orientation": quaternions(),
                    },
                )
            )
        )
        sections["agent_{}".format(index)] = section
    return sections


@st.composite
def polygons(draw):
    centre = draw(st.tuples(coordinate, coordinate))
    corners = draw(st.integers(3, 9))
    turn = draw(st.sampled_from([1.0, -1.0])) * 2.0 * math.pi / corners
    size = draw(st.floats(0.1, 10.0))
    return [
        [centre[0] + size * math.cos(turn * k), centre[1] + size * math.sin(turn * k)]
        for k in range(corners)
    ]


@st.composite
def scenario_mappings(draw):
    length = draw(st.floats(0.5, 10.0))
    segments = draw(st.integers(2, 60))
    obstacle = st.fixed_dictionaries(
        {"polygon": polygons()},
        optional={
            "plane": st.sampled_from(["xy", "yz", "xz"]),
            "translation": point,
            "rotation": quaternions(),
        },
    )
    obstacles = draw(st.lists(obstacle, max_size=3))
    for index, section in enumerate(obstacles):
        section["name"] = "obstacle {}".format(index)
    times = [0.0] + sorted(draw(st.sets(st.integers(1, 1000), max_size=4)))
    return {
        "name": draw(st.from_regex(r"[a-z0-9\u00e4~][ -.0-9A-Za-z\u00e4]{0,8}", fullmatch=True)),
        "object": {
            "type": "rod",
            "length": length,
            "radius": 0.01,
            "density": draw(st.floats(1e-3, 1e5)),
            "segments": segments,
            "young_modulus": draw(positive),
            "torsion_modulus": draw(positive.map(str)),
            "stretch": draw(st.sampled_from(["zero", "from_moduli"])),
            "pose": {"position": draw(point), "orientation": draw(quaternions())},
        },
        "agents": draw(agent_sections(length, segments)),
        "obstacles": obstacles,
        "leader": {
            "waypoints": [
                {"time": time, "position": draw(waypoint) if time else [0, 0, 0]} for time in times
            ]
        },
        "controller": {
            "rate": 50,
            "feedforward": draw(st.booleans()),
            "perturbation": [1e-3, -1e-3, 1e-4],
            "collision": {"offset": draw(st.floats(0, 1)), "alpha": draw(slopes)},
            "proximity": {"min_distance": draw(st.sampled_from(["auto", 0, 1e-4]))},
        },
        "simulation": {"duration": draw(st.floats(0.1, 1e5)), "time_step": 0.02},
    }


def assert_suits_the_parameter_server(value):
    if isinstance(value, dict):
        assert all(isinstance(key, str) for key in value)
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            assert_suits_the_parameter_server(item)
    elif isinstance(value, int):
        assert abs(value) < 2**31
    elif isinstance(value, float):
        assert math.isfinite(value)
    else:
        assert isinstance(value, str)


@settings(max_examples=60, deadline=None)
@given(raw=scenario_mappings())
def test_round_trip(raw):
    scenario = scenario_from_mapping(raw, "/nowhere")
    mapping = scenario_to_mapping(scenario)
    assert_suits_the_parameter_server(mapping)
    assert scenario_from_mapping(mapping, "/nowhere") == scenario
    reloaded = yaml.safe_load(scenario_to_yaml(scenario))
    assert reloaded == mapping
    assert list(reloaded["agents"]) == list(raw["agents"])


junk = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.sampled_from([10**400, -(2**31), 0, -1])
    | st.floats()
    | st.text(max_size=8)
    | st.binary(max_size=4)
    | st.just(datetime.date(2001, 1, 1))
    | st.just({1, 2}),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text(max_size=5) | st.integers() | st.none(), inner, max_size=3)
    ),
    max_leaves=8,
)


def places(value):
    """Every container of a nested value, with each of its keys or indices."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in list(items):
        yield value, key
        if isinstance(item, (dict, list)):
            yield from places(item)


@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_corrupted_mappings_raise_nothing_but_scenario_errors(correct, data):
    mapping = copy.deepcopy(correct)
    for _ in range(data.draw(st.integers(1, 3))):
        container, key = data.draw(st.sampled_from(list(places(mapping)) or [({"x": 0}, "x")]))
        action = data.draw(st.sampled_from(["replace", "remove", "rename"]))
        if action == "replace":
            container[key] = data.draw(junk)
        elif action == "remove":
            del container[key]
        elif isinstance(container, dict):
            container[data.draw(st.text(max_size=6) | st.integers())] = container.pop(key)
    try:
        scenario = scenario_from_mapping(mapping, "/nowhere")
    except ScenarioError as error:
        assert error.problems
        assert all(len(str(problem).splitlines()) == 1 for problem in error.problems)
    else:
        assert scenario_from_mapping(scenario_to_mapping(scenario), "/nowhere") == scenario


YAML_PIECES = [b"", b"\n", b"\t", b": ", b"- ", b"&a ", b"*a", b"!!int ", b"<<: ", b"'", b"{", b"]"]


@pytest.fixture(scope="module")
def scratch_file(tmp_path_factory):
    return tmp_path_factory.mktemp("corrupted") / "scenario.yaml"


@settings(max_examples=200, deadline=None)
@given(data=st.data())
def test_corrupted_files_raise_nothing_but_scenario_errors(correct, scratch_file, data):
    text = yaml.safe_dump(correct, sort_keys=False).encode("utf-8")
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(start, min(len(text), start + 20)))
        piece = data.draw(st.sampled_from(YAML_PIECES) | st.binary(max_size=4))
        text = text[:start] + piece + text[end:]
    scratch_file.write_bytes(text)
    try:
        load_scenario(scratch_file)
    except ScenarioError as error:
        assert error.problems
