"""The live obstacles of a run, from their topics."""

import rospy

from deformable_manipulation.ros.live_source import LiveSource
from deformable_manipulation.ros.transforms import Transforms
from deformable_manipulation.seeing.camera_times import CameraTimes
from deformable_manipulation.seeing.carried_state import CarriedState, StateHistory
from deformable_manipulation.seeing.seen_obstacles import SeenObstacles, live_obstacles
from deformable_manipulation.seeing.sight import is_of_camera


class LiveObstacles:
    """What is seen of live obstacles; puts it into a minimum distance, between two states.

    Reads the node's parameters ``~lockstep`` and ``~camera``: with both, a state waits for the
    image of the scenario's camera that is due before it.

    Args:
        scenario: the checked scenario.
        distance: MinimumDistance; None: others compute the distances, and show what is used.
    """

    def __init__(self, scenario, distance=None):
        indices = live_obstacles(scenario)
        lockstep = rospy.get_param("~lockstep", False)
        self._history = StateHistory()
        transforms = Transforms(scenario.frame)
        self._sources = {
            index: LiveSource(
                scenario, index, self._history, transforms, lockstep, distance is not None
            )
            for index in indices
        }
        places = {} if distance is None else {index: index for index in indices}
        self._seen = SeenObstacles(distance, places)
        self._cycle_time = scenario.cycle_time
        self._reset_count = None
        self._awaited = []
        if lockstep and rospy.get_param("~camera", False):
            self._camera = CameraTimes(scenario)
            self._awaited = [
                source for index, source in self._sources.items() if is_of_camera(scenario, index)
            ]

    def move(self, state, points, carried):
        """Let the distances of a state be from what is seen by now.

        Args:
            state: ObjectState.
            points: (C, P, 3) m, of its copies.
            carried: held points (A, 3) [m] and orientations (A, 4), in the scenario's order.

        Returns:
            Which obstacles are lost, as a clause; empty where all are known.
        """
        if not self._sources:
            return ""
        stamp = state.header.stamp.to_sec()
        if self._reset_count not in (None, state.reset_count):
            for source in self._sources.values():
                source.reset()
        self._reset_count = state.reset_count
        self._history.add(CarriedState(stamp, points[0].copy(), *carried))
        self._await_image(state, stamp)
        self._seen.show(self.seen())
        for source in self._sources.values():
            source.answered(stamp, points)
        faults = (source.fault(stamp) for source in self._sources.values())
        return ", ".join(filter(None, faults))

    def seen(self):
        """What is known of the obstacles, by their indices."""
        return {i: source.seen for i, source in self._sources.items() if source.seen is not None}

    def _await_image(self, state, stamp):
        if self._awaited:
            due = self._camera.last_before(state.cycle)
            if due is not None:
                for source in self._awaited:
                    source.await_data(stamp - (state.cycle - due) * self._cycle_time)
