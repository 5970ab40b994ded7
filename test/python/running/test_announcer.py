"""Announcements of a leader in runs without ROS, right and wrong, and what they change."""

import numpy as np
import pytest

from deformable_manipulation.motion.leader import LeaderController
from deformable_manipulation.running.announcer import Announcer
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.knowledge import DELAYED, OPPOSITE, RANDOM, SCALED

ANNOUNCED = ("controller.horizon.leader", "announced")
DIVE = [
    {"time": 0.0, "position": [0.0, 0.0, 0.0]},
    {"time": 4.0, "position": [0.0, 0.0, 0.0]},
    {"time": 7.0, "position": [0.0, 0.0, -0.8]},
]


def scenario(*overrides):
    return load_scenario("rope_one_assistant", overrides)


def announcer(kind):
    chosen = scenario(ANNOUNCED, ("knowledge.intent", kind))
    return Announcer(chosen, LeaderController(chosen))


def test_nothing_is_announced_where_nobody_wants_to_know():
    fading = scenario()
    assert Announcer(fading, LeaderController(fading)).announce(1.0) is None


def test_wrong_announcements_are_as_wrong_as_they_say():
    honest = announcer("honest").announce(18.0)
    moves = honest.positions - honest.positions[0]
    assert np.abs(moves).max() > 0.1
    opposite, scaled = announcer(OPPOSITE).announce(18.0), announcer(SCALED).announce(18.0)
    np.testing.assert_allclose(opposite.positions - opposite.positions[0], -moves)
    np.testing.assert_allclose(scaled.positions - scaled.positions[0], 2.0 * moves)
    delayed = announcer(DELAYED).announce(19.0)
    np.testing.assert_allclose(delayed.positions, honest.positions)
    np.testing.assert_allclose(delayed.times, honest.times + 1.0)
    random = announcer(RANDOM)
    first, again, later = (random.announce(time).positions for time in (18.0, 18.0, 19.0))
    np.testing.assert_array_equal(first, again)
    assert np.abs((later - later[0]) - (first - first[0])).max() > 0.1


def decisions(*overrides):
    loop = ClosedLoop(scenario(("leader.waypoints", str(DIVE)), *overrides))
    return [loop.step().decisions["assistant_1"] for _ in range(800)]


@pytest.mark.parametrize("leader", ["announced", "known"])
def test_who_knows_that_the_leader_will_stop_gives_way_less(leader):
    """It dives with twice the assistant's velocity, but ends far above the ground."""
    farthest = {}
    for name in ("fading", leader):
        run = decisions(("controller.horizon.leader", name))
        farthest[name] = max(each.error_norm for each in run)
        assert min(each.distance for each in run) > 0.05
    assert farthest[leader] < 0.7 * farthest["fading"]


@pytest.mark.parametrize("kind, largest", [(OPPOSITE, 0.0), (RANDOM, 0.01)])
def test_what_has_misled_changes_nothing(kind, largest):
    """The leader rests for so long that what it announces falsely has been seen to be false.

    A random velocity is right by chance at times, and its trust is not quite zero.
    """
    wrong = decisions(ANNOUNCED, ("knowledge.intent", kind))
    fading = decisions()
    difference = [np.abs(a.position - b.position).max() for a, b in zip(wrong, fading)]
    assert max(difference) <= largest  # m
    assert max(each.error_norm for each in fading) > 0.9
