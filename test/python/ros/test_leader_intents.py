"""Announcements and the states that wait for them."""

import numpy as np
import pytest
from messages import state_message, transmitted
from nav_msgs.msg import Path

from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.ros import leader_intents
from deformable_manipulation.ros.conversions import fill_path
from deformable_manipulation.scenario import load_scenario

PLACES = np.array([[0.0, 0.0, 1.0], [0.0, 0.1, 1.0]])


@pytest.fixture
def scenario():
    return load_scenario("rope_one_assistant", [("controller.horizon.leader", "announced")])


@pytest.fixture
def intents(scenario, monkeypatch):
    """Makes a LeaderIntents that nobody else talks to."""
    monkeypatch.setattr(leader_intents.node, "subscribe", lambda *_: None)
    return lambda lockstep: leader_intents.LeaderIntents(scenario, lockstep)


def state(cycle, reset_count=0):
    return state_message(stamp=1.0 + 0.01 * cycle, cycle=cycle, reset_count=reset_count)


def announcement(scenario, cycle, y=0.0):
    now = cycle * scenario.cycle_time
    intent = Intent(now + np.array([0.0, 1.0]), PLACES + [0.0, y, 0.0])
    return transmitted(fill_path(Path(), state(cycle), scenario.cycle_time, "map", intent))


class Answers:
    def __init__(self):
        self.given = []

    def __call__(self, state, intent):
        self.given.append((state.cycle, None if intent is None else intent.positions[0, 1]))


def test_in_lock_step_a_state_is_answered_with_what_answered_the_one_before(intents, scenario):
    waiting, answers = intents(True), Answers()
    waiting.pass_on(state(0), answers)  # no state was before it
    waiting.pass_on(state(1), answers)
    assert answers.given == [(0, None)]
    waiting._take(announcement(scenario, 0, y=0.5))
    waiting._take(announcement(scenario, 1, y=0.6))  # the leader is one state ahead
    waiting.pass_on(state(2), answers)
    assert answers.given == [(0, None), (1, 0.5), (2, 0.6)]


def test_in_lock_step_nobody_waits_after_a_reset(intents, scenario):
    waiting, answers = intents(True), Answers()
    waiting.pass_on(state(0), answers)
    waiting.pass_on(state(1), answers)  # waits
    waiting.pass_on(state(0, reset_count=1), answers)
    assert answers.given == [(0, None), (0, None)]


def test_in_real_time_the_newest_counts_while_it_is_not_old(intents, scenario):
    newest, answers = intents(False), Answers()
    newest.pass_on(state(3), answers)
    newest._take(announcement(scenario, 3, y=0.3))
    newest._take(announcement(scenario, 4, y=0.4))
    newest.pass_on(state(5), answers)
    timeout = round(scenario.controller.timeout / scenario.cycle_time)
    newest.pass_on(state(5 + timeout), answers)
    assert answers.given == [(3, None), (5, 0.4), (5 + timeout, None)]


def test_what_cannot_be_used_is_ignored_with_a_warning(intents, scenario, monkeypatch):
    warned = []
    monkeypatch.setattr(leader_intents.node.rospy, "logwarn", warned.append)
    newest, answers = intents(False), Answers()
    broken = announcement(scenario, 3)
    broken.poses[0].pose.position.x = np.nan
    newest._take(broken)
    newest.pass_on(state(4), answers)
    assert answers.given == [(4, None)]
    assert warned == [
        "An announcement of the leader is ignored: position 0 or its time is not finite."
    ]


def test_in_real_time_the_leader_announces_no_more_than_it_has_to(scenario, monkeypatch):
    sent = []

    class Publisher:
        def __init__(self, *_arguments, **_options):
            self.publish = sent.append

    monkeypatch.setattr(leader_intents, "DirectPublisher", Publisher)
    publisher = leader_intents.IntentPublisher(scenario, lockstep=False)
    publisher.tell(state(0), None)  # there is nothing to take back
    for cycle in range(1, 11):
        publisher.tell(state(cycle), Intent(np.array([0.0, 1.0]), PLACES))
    publisher.tell(state(11), None)
    publisher.tell(state(12), None)
    assert [(len(each.poses), each.header.stamp.to_sec()) for each in sent] == [
        (2, pytest.approx(1.01)),
        (2, pytest.approx(1.06)),
        (0, pytest.approx(1.11)),
    ]
