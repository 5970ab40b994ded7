"""The fabric between clamp bars: it turns with its leader, and limits are kept meanwhile."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

NAME = "fabric_clamp_bars"
TURNED = 30.0  # s, after the turn, when the fabric is low over the table


class Run:
    """Records of all cycles, and the grips at the end."""

    def __init__(self, *overrides, safety=True):
        self.scenario = load_scenario(NAME, overrides)
        loop = ClosedLoop(self.scenario, safety)
        self.records = [loop.step() for _ in range(self.scenario.cycles)]
        self.decisions = [record.decisions["assistant_1"] for record in self.records]
        self.grips = Rotation.from_quat(loop._simulation.orientations())

    def lowest(self, name):
        return min(decision.h[name] for decision in self.decisions)


@pytest.fixture(scope="module")
def turning():
    return Run(("simulation.duration", str(TURNED)))


def test_limits_are_kept_and_met_while_it_turns(turning):
    assert 0.0 <= turning.lowest("collision") < 0.02
    assert 0.0 <= turning.lowest("strain") < 0.002
    assert turning.lowest("overstretch") >= 0.0
    for decision in turning.decisions:
        assert decision.exact_jacobian
        assert np.abs(list(decision.slack.values())).max() < 1e-6


def test_place_and_bar_turn_with_the_leader(turning):
    """By a right angle; the assistant has left its place by no more than it needs."""
    quarter = Rotation.from_rotvec([0.0, 0.0, 0.5 * np.pi])
    assert (turning.grips[0] * quarter.inv()).magnitude() < 1e-3
    assert (turning.grips[1] * turning.grips[0].inv()).magnitude() < 0.02
    starts = np.array([agent.start for agent in turning.scenario.agents])
    last = turning.records[-1]
    place = last.positions[0] + quarter.apply(starts[1] - starts[0])
    np.testing.assert_allclose(turning.decisions[-1].target, place, atol=1e-3)
    assert 0.02 < np.linalg.norm(last.positions[1] - place) < 0.1
    bar = list(turning.scenario.agents[1].particles)
    spread = last.points[bar] - last.points[bar[0]]
    assert np.abs(spread[:, 0]).max() < 0.02  # along y now
    np.testing.assert_allclose(np.ptp(spread[:, 1]), 1.0, atol=1e-3)


def test_without_the_barriers_the_fabric_goes_through_the_table():
    unsafe = Run(("simulation.duration", "38.0"), ("controller.rate", "20"), safety=False)
    assert min(record.distance for record in unsafe.records) < 0.0


def lowered(*overrides):
    """A leader that goes straight down over the table, which is under the leader's half."""
    return Run(
        ("obstacles.0.box.size", "[1.2, 0.6, 0.7]"),
        ("obstacles.0.translation", "[0.0, 0.55, 0.35]"),
        ("leader.waypoints", "[{time: 0, position: [0, 0, 0]}, {time: 6, position: [0, 0, -0.2]}]"),
        ("simulation.duration", "7.0"),
        *overrides,
    )


FREE = (
    ("controller.orientation", "free"),
    ("controller.turning_weights", "[0.05, 0.05, 0.05]"),  # to turn costs nearly nothing
)


@pytest.fixture(scope="module")
def free():
    return lowered(*FREE, ("controller.grip_force", "{max_force: 100.0}"))


def test_a_free_bar_turns_where_that_serves_the_limits(free):
    """Both keep the fabric off the table; the one that turns leaves its place less."""
    fixed = lowered(("controller.orientation", "fixed"))
    for run in (free, fixed):
        assert 0.0 <= run.lowest("collision") < 0.02
        assert run.lowest("strain") >= 0.0
    start = Rotation.from_quat(free.scenario.agents[1].orientation)
    assert (free.grips[1] * start.inv()).magnitude() > 0.02
    left = [
        np.linalg.norm(run.records[-1].positions[1] - run.decisions[-1].target)
        for run in (free, fixed)
    ]
    assert left[0] < left[1]


def test_a_limit_of_force_is_kept_by_bars_that_turn(free):
    """It is exceeded without; both limits hold at a time, without slack."""
    limit = 23.0  # N
    assert 100.0 - free.lowest("grip_force") > limit + 2.0
    limited = lowered(*FREE, ("controller.grip_force", f"{{max_force: {limit}}}"))
    assert 0.0 <= limited.lowest("grip_force") < 1.0
    assert limited.lowest("collision") >= 0.0
    for decision in limited.decisions:
        assert np.abs(list(decision.slack.values())).max() < 1e-6
