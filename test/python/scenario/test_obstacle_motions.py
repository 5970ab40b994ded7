"""The motion of an obstacle in the scenario file."""

import pytest

from deformable_manipulation.commands.check_scenario import summary
from deformable_manipulation.scenario import scenario_from_mapping, scenario_to_mapping
from deformable_manipulation.scenario.spec import (
    FrameMotion,
    PathMotion,
    PoseWaypoint,
    TopicMotion,
)

PATH = {
    "waypoints": [
        {"time": 1.0},
        {"time": 2.0, "position": [0.0, 0.1, 0.0], "orientation": [0.0, 0.0, 0.6, 0.8]},
    ]
}
KEY = "obstacles.0.motion"


@pytest.fixture
def with_motion(mapping, change):
    """Function: the mapping with a motion of its obstacle."""
    return lambda motion: change(mapping, KEY, motion)


@pytest.mark.parametrize(
    "motion, expected, words",
    [
        (
            PATH,
            PathMotion(
                (
                    PoseWaypoint(1.0),
                    PoseWaypoint(2.0, (0.0, 0.1, 0.0), (0.0, 0.0, 0.6, 0.8)),
                )
            ),
            "moves through 2 waypoints, 2 s",
        ),
        ({"topic": "/block/pose"}, TopicMotion("/block/pose"), "pose from topic /block/pose"),
        ({"frame": "tool0"}, FrameMotion("tool0"), "pose of tf frame tool0"),
    ],
)
def test_it_is_read_told_and_written(with_motion, tmp_path, motion, expected, words):
    scenario = scenario_from_mapping(with_motion(motion), tmp_path)
    assert scenario.obstacles[0].motion == expected
    assert any(line.endswith(words) for line in summary(scenario))
    assert scenario_from_mapping(scenario_to_mapping(scenario), tmp_path) == scenario


def test_an_obstacle_stands_where_none_is_given(mapping, tmp_path):
    scenario = scenario_from_mapping(mapping, tmp_path)
    assert scenario.obstacles[0].motion is None
    assert "motion" not in scenario_to_mapping(scenario)["obstacles"][0]


@pytest.mark.parametrize("motion", [{}, None, 3, {"topic": "a", "frame": "b"}, {"topics": "a"}])
def test_there_is_exactly_one_source(with_motion, problems_of, motion):
    assert (
        "must be a section with one of the keys waypoints, topic, frame"
        in problems_of(with_motion(motion))[KEY]
    )


@pytest.mark.parametrize(
    "motion, key, words",
    [
        ({"topic": "/two words"}, "topic", "a ROS topic"),
        ({"topic": "a//b"}, "topic", "a ROS topic"),
        ({"topic": 3}, "topic", "a ROS topic"),
        ({"frame": ""}, "frame", "a tf frame"),
        ({"frame": "map"}, "frame", "must not be the fixed frame"),
        ({"topic": "a", "rate": 3}, "rate", "is not a key here"),
        ({"waypoints": []}, "waypoints", "must be a list of waypoints"),
        ({"waypoints": [{"time": -1.0}]}, "waypoints.0.time", ">= 0"),
        ({"waypoints": [{"time": 1.0}, {"time": 1.0}]}, "waypoints.1.time", "at least 0.001 s"),
        ({"waypoints": [{"time": 1.0, "position": [0, 0]}]}, "waypoints.0.position", "[x, y, z]"),
        (
            {"waypoints": [{"time": 1.0, "orientation": [0, 0, 0, 2]}]},
            "waypoints.0.orientation",
            "of norm 1",
        ),
        ({"waypoints": [{"position": [0, 0, 0]}]}, "waypoints.0.time", "is missing"),
    ],
)
def test_mistakes_are_told(with_motion, problems_of, motion, key, words):
    assert words in problems_of(with_motion(motion))["{}.{}".format(KEY, key)]


def test_the_paper_s_formulation_knows_no_moving_obstacles(mapping, change, tmp_path, problems_of):
    change(mapping, "controller.formulation", "paper")
    assert not scenario_from_mapping(mapping, tmp_path).controller.collision.obstacle_velocity
    change(mapping, "controller.collision.obstacle_velocity", True)
    assert "paper" in problems_of(mapping)["controller.collision.obstacle_velocity"]
