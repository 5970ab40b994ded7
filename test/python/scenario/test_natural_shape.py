"""The keys natural_shape and point_masses of rods: what they mean and what they refuse."""

import math

import numpy as np
import pytest

from deformable_manipulation.geometry.rotation import multiply
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario import (
    ScenarioError,
    load_scenario,
    scenario_from_mapping,
    scenario_to_mapping,
)

ROPE = "rope_one_assistant"


def loaded(*overrides):
    return load_scenario(ROPE, [tuple(each.split("=", 1)) for each in overrides])


def short_rope(*overrides):
    """A rope of 1 m in 20 segments, held at its ends."""
    follower = "{particle: 19, role: assistant}"
    agents = f"agents={{leader: {{particle: 0, role: leader}}, follower: {follower}}}"
    return loaded("object.length=1.0", "object.segments=20", agents, *overrides)


def rod(*overrides):
    starts = ["agents.leader.start=[0, 0, 1.8]", "agents.follower.start=[0, 0.6, 1.8]"]
    return short_rope(*starts, *overrides).object


def test_a_rope_is_straight_without_the_key():
    spec = load_scenario(ROPE).object
    assert spec.natural_shape is None and spec.point_masses == ()
    assert "natural_shape" not in spec.to_mapping()
    ends = make_body(spec).points()[0]
    assert np.abs(np.diff(ends, n=2, axis=0)).max() < 1e-12


def circle(radius, length, count):
    angles = np.linspace(0.0, length / radius, count)
    return np.stack([radius * np.sin(angles), radius * (1 - np.cos(angles)), 0 * angles], axis=1)


def test_a_file_of_points_is_the_curvature_that_it_has(tmp_path):
    path = tmp_path / "arc.csv"
    np.savetxt(path, circle(0.4, 1.0, 400), delimiter=",", header="x,y,z", comments="")
    by_file = rod(f"object.natural_shape={{points: {path}}}")
    by_number = rod("object.natural_shape={curvature: [0.0, 2.5]}")
    points = make_body(by_file).points()[0]
    np.testing.assert_allclose(points, make_body(by_number).points()[0], atol=1e-3)


def test_agents_hold_the_rod_as_it_is_without_load():
    bent = short_rope("object.natural_shape={curvature: [0.0, 1.5]}")
    leader, follower = bent.agents
    turn = 1.5 * (1.0 - 1.0 / 20)  # rad, from the first centre to the last
    about_z = (0.0, 0.0, math.sin(0.5 * turn), math.cos(0.5 * turn))
    assert follower.orientation == pytest.approx(multiply(leader.orientation, about_z), abs=1e-9)
    distance = math.dist(leader.start, follower.start)
    assert distance == pytest.approx(2.0 / 1.5 * math.sin(0.5 * turn), rel=1e-3)


def test_a_resolved_scenario_means_the_same():
    scenario = loaded(
        "object.natural_shape={curvature: [0.1, 0.2], twist: 0.3}",
        "object.point_masses=[{at: 0.5, mass: 0.1}]",
    )
    again = scenario_from_mapping(scenario_to_mapping(scenario), ".")
    assert again.object == scenario.object
    assert scenario.object.mass == pytest.approx(load_scenario(ROPE).object.mass + 0.1)


@pytest.mark.parametrize(
    "override, key, reason",
    [
        ("natural_shape={curvature: [0.0, 90.0]}", "natural_shape", "at least 90 segments"),
        ("natural_shape={curvature: 2.0}", "natural_shape.curvature", "[about y, about z]"),
        ("natural_shape={bend: 2.0}", "natural_shape.bend", "is not a key here"),
        ("natural_shape={points: [[0, 0, 0]]}", "natural_shape.points", "at least two points"),
        (
            "natural_shape={points: [[0, 0, 0], [0, 0, 0], [1, 0, 0]]}",
            "natural_shape.points",
            "are the same",
        ),
        (
            "natural_shape={points: [[0, 0, 0], [1, 0, 0], [2, 0.1, 0]]}",
            "natural_shape.points",
            "as long as the rod",
        ),
        (
            "natural_shape={points: [[0, 0, 0], [0.5, 0, 0], [0.5, 0.5, 0]]}",
            "natural_shape",
            "smoother line",
        ),
        (
            "natural_shape={points: [[0, 0, 0], [1, 0, 0]], curvature: [0.0, 1.0]}",
            "natural_shape",
            "not both",
        ),
        ("natural_shape={points: nowhere.csv}", "natural_shape.points", "nowhere.csv"),
        ("point_masses=[{at: 1.2, mass: 0.1}]", "point_masses.0.at", "on the rod, 0 to 1 m"),
        ("point_masses=[{at: 0.2, mass: 0.0}]", "point_masses.0.mass", "> 0"),
        ("point_masses=[{at: 0.2}]", "point_masses.0.mass", "is missing"),
    ],
)
def test_mistakes_are_named(override, key, reason):
    with pytest.raises(ScenarioError) as error:
        rod("object." + override)
    text = str(error.value)
    assert "object." + key in text and reason in text
