#!/usr/bin/env python3
"""Messages between simulator and controller are delayed, lost, repeated, swapped and spoiled.

The test is what carries the controller's inputs, and what spoils them. A node that computes the
distances itself has the states alone.
"""

import copy

import numpy as np
import rospy
from faulty_run import FOLLOWING, FaultTest
from observed_run import run_tests
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.msg import Distances, ObjectState

OVERDUE = 1.0  # s
LATE = 5  # cycles, well within the timeout


class Relay:
    """Passes a topic's messages on as ``carry(message)``, a list, wants it."""

    def __init__(self, topic, message_class):
        self.carry = intact
        self._publisher = rospy.Publisher("relayed/" + topic, message_class, queue_size=100)
        self._subscriber = rospy.Subscriber(
            topic, message_class, self._pass_on, queue_size=100, tcp_nodelay=True
        )

    def _pass_on(self, message):
        for each in self.carry(message):
            self._publisher.publish(each)


def intact(message):
    return [message]


def lost(_message):
    return []


def twice(message):
    return [message, message]


class Swapped:
    """Messages of even cycles come after those that follow them.

    Receivers take in the newer ones only: were the order not the same on both topics, there would
    be states of even cycles and distances of odd ones.
    """

    def __init__(self):
        self._held = None

    def __call__(self, message):
        if message.cycle % 2 == 1:
            return [message]
        held, self._held = self._held, message
        return [] if held is None else [held]


class Delayed:
    """Messages wait until one comes that is so much newer [s]."""

    def __init__(self, delay):
        self._delay = rospy.Duration(delay)
        self._waiting = []

    def __call__(self, message):
        self._waiting.append(message)
        due = message.header.stamp - self._delay
        ready = [each for each in self._waiting if each.header.stamp <= due]
        self._waiting = self._waiting[len(ready) :]
        return ready


def spoiled(**changes):
    """``changes``: for each field a function of its value."""

    def carry(message):
        message = copy.copy(message)
        for name, change in changes.items():
            setattr(message, name, change(getattr(message, name)))
        return [message]

    return carry


def with_nan(values):
    values = np.array(values)
    values[0] = np.nan
    return values


def without_last(values):
    return values[:-1]


def in_another_frame(header):
    header = copy.copy(header)
    header.frame_id = "tool0"
    return header


def without_last_of(fields):
    return [spoiled(**{name: without_last}) for name in fields]


def with_nan_in(fields):
    return [(spoiled(**{name: with_nan}), text) for name, text in fields.items()]


class FaultMessagesTest(FaultTest):
    @classmethod
    def setUpClass(cls):
        cls.relays = {"state": Relay("state", numpy_msg(ObjectState))}
        if not rospy.get_param("one_process"):
            cls.relays["distances"] = Relay("distances", numpy_msg(Distances))
        super().setUpClass()

    def tearDown(self):
        self.carry(intact, *self.relays)

    def carry(self, how, *topics):
        for topic in topics:
            self.relays[topic].carry = copy.deepcopy(how)  # some remember messages
        return rospy.Time.now()

    def assert_stops_and_goes_on(self, topics, how, *words):
        """The assistant stops, saying why with these words, and follows again afterwards."""
        if not self.relays.keys() >= set(topics):
            return
        with self.subTest(topics=topics, words=words):
            since = self.carry(how, *topics)
            self.assert_stops(since)
            self.assert_waits(*words)
            self.carry(intact, *topics)
            self.assert_follows()

    def assert_goes_on_with(self, topics, how):
        """The assistant follows as if nothing was, each cycle answered once, in order."""
        if not self.relays.keys() >= set(topics):
            return
        with self.subTest(topics=topics):
            self.carry(how, *topics)
            self.decisions.wait_for_more(2 * LATE)  # those under way
            decisions = self.assert_goes_on()
            cycles = [each.cycle for each in decisions if each.status in FOLLOWING]
            self.assertEqual(cycles, sorted(set(cycles)))
            self.carry(intact, *topics)
            self.assert_follows()

    def test_lost(self):
        self.assert_stops_and_goes_on(["state"], lost, "no state for")
        self.assert_stops_and_goes_on(["distances"], lost, "no distances for")
        self.assert_stops_and_goes_on(["state", "distances"], lost, "no state for", "no distances")

    def test_delayed_beyond_the_timeout(self):
        self.assert_stops_and_goes_on(["state", "distances"], Delayed(OVERDUE), "s old")
        self.assert_stops_and_goes_on(["state"], Delayed(OVERDUE), "s old")
        self.assert_stops_and_goes_on(["distances"], Delayed(OVERDUE), "s old")

    def test_distances_that_are_never_of_the_cycle_of_a_state(self):
        another_cycle = spoiled(cycle=lambda cycle: cycle + 1000000)
        self.assert_stops_and_goes_on(
            ["distances"], another_cycle, "no state with the distances of its cycle for"
        )

    def test_delayed_within_the_timeout(self):
        delay = LATE * self.scenario.cycle_time
        self.assert_goes_on_with(["distances"], Delayed(delay))
        self.assert_goes_on_with(["state"], Delayed(delay))
        self.assert_goes_on_with(["state", "distances"], Delayed(delay))

    def test_repeated(self):
        for topics in (["state"], ["state", "distances"]):
            self.assert_goes_on_with(topics, twice)

    def test_swapped(self):
        for topics in (["state"], ["distances"], ["state", "distances"]):
            self.assert_goes_on_with(topics, Swapped())

    def test_not_finite(self):
        for how, name in with_nan_in(
            {"agent_positions": "positions", "points": "points", "displacements": "displacements"}
        ):
            self.assert_stops_and_goes_on(["state"], how, name, "not finite")
        for how, name in with_nan_in(
            {
                "minimum_distances": "distances.minimum",
                "feature_distances": "distances.distance",
                "normals": "distances.normal",
            }
        ):
            self.assert_stops_and_goes_on(["distances"], how, name, "not finite")

    def test_in_another_frame(self):
        how = spoiled(header=in_another_frame)
        for topic in self.relays:
            self.assert_stops_and_goes_on([topic], how, topic, "'tool0'", "'map'")

    def test_of_the_wrong_size(self):
        for how in without_last_of(
            ["agents", "agent_positions", "points", "displaced_agents", "copy_ready"]
        ):
            self.assert_stops_and_goes_on(["state"], how, "cannot be used")
        for how in without_last_of(
            [
                "minimum_distances",
                "feature_offsets",
                "feature_distances",
                "normals",
                "feature_vertices",
                "feature_weights",
            ]
        ):
            self.assert_stops_and_goes_on(["distances"], how, "Waits")


if __name__ == "__main__":
    run_tests("fault_messages")
