"""The leader's announcements on ``<leader>/intent``."""

import threading
from collections import deque

from nav_msgs.msg import Path

from deformable_manipulation.cycles.input_watch import find_age_fault
from deformable_manipulation.motion.intent import leader_announces
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import MessageError, fill_path, to_leader_intent
from deformable_manipulation.ros.direct_publisher import DirectPublisher

_PERIOD = 0.05  # s, between announcements in real time: a path costs more than a command


def _topic(scenario):
    return f"{scenario.agents[scenario.leader_index].name}/intent"


class IntentPublisher:
    """Announces where the leader will be, if the scenario's controllers want to know.

    In lock-step each state is answered by an announcement, even an empty one, because the
    assistants wait for it. In real time there is one in 0.05 s, while there is anything to
    announce.

    Args:
        scenario: the checked scenario.
        lockstep: whether everybody waits for everybody.
    """

    def __init__(self, scenario, lockstep):
        self._frame = scenario.frame
        self._cycle_time = scenario.cycle_time
        self._lockstep = lockstep
        self._last = None  # stamp and whether anything was announced
        self._publisher = None
        if leader_announces(scenario):
            self._publisher = DirectPublisher(_topic(scenario), Path, latch=lockstep)

    def tell(self, state, intent):
        """Announce an Intent, or that there is none, with a state that is answered."""
        if self._publisher is not None and (self._lockstep or self._is_due(state, intent)):
            self._last = state.header.stamp, intent is not None
            self._publisher.publish(fill_path(Path(), state, self._cycle_time, self._frame, intent))

    def _is_due(self, state, intent):
        if self._last is None:
            return intent is not None
        stamp, announced = self._last
        passed = abs((state.header.stamp - stamp).to_sec())
        return announced != (intent is not None) or (intent is not None and passed >= _PERIOD)


class LeaderIntents:
    """What the leader has announced, for the states that are to be answered.

    Args:
        scenario: the checked scenario.
        lockstep: each state waits for the announcement that answers the state before, if the
            package's leader makes them.
    """

    def __init__(self, scenario, lockstep):
        self._scenario = scenario
        self._awaited = lockstep and leader_announces(scenario)
        self._lock = threading.RLock()  # states and announcements come in different threads
        self._warnings = node.Warnings()
        # In lock-step the leader may be one state ahead: it does not wait for the assistants.
        self._newest = deque(maxlen=2 if self._awaited else 1)  # announcements
        self._before = None  # the state before
        self._waiting = None  # for an announcement of a stamp: stamp, state, what answers it
        if scenario.controller.horizon.announced:
            queue_size = self._newest.maxlen
            node.subscribe(_topic(scenario), Path, self._take, queue_size)

    def pass_on(self, state, answer):
        """Call ``answer(state, intent)`` with the Intent, or None, as soon as it is known."""
        with self._lock:
            stamp = self._stamp_before(state)
            self._before = state
            self._waiting = None
            if not self._awaited:
                answer(state, self._intent(self._newest[0] if self._newest else None, state))
            elif stamp is None:
                answer(state, None)
            else:
                self._waiting = stamp, state, answer
                self._answer_waiting()

    def _take(self, message):
        with self._lock:
            self._newest.append(message)
            self._answer_waiting()

    def _answer_waiting(self):
        """Answer the state that waits, once what it waits for has come."""
        if self._waiting is None:
            return
        stamp, state, answer = self._waiting
        for message in self._newest:
            if message.header.stamp == stamp:
                self._waiting = None
                answer(state, self._intent(message, state))
                return

    def _stamp_before(self, state):
        """Stamp of the state before, if there was one in this run."""
        before = self._before
        if before is None or before.reset_count != state.reset_count:
            return None
        return before.header.stamp if before.cycle == state.cycle - 1 else None

    def _intent(self, message, state):
        if message is None or not message.poses:
            return None
        age = (state.header.stamp - message.header.stamp).to_sec()
        if age > self._scenario.controller.timeout:
            return None
        try:
            fault = find_age_fault(age, self._scenario.controller.timeout)
            if fault:
                raise MessageError(fault)
            return to_leader_intent(message, state, self._scenario)
        except MessageError as error:
            self._warnings.warn(f"An announcement of the leader is ignored: {error}.")
            return None
