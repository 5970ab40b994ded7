"""What the controllers of a run without ROS see of live obstacles."""

from typing import Dict

from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.camera_times import CameraTimes
from deformable_manipulation.seeing.carried_state import CarriedState
from deformable_manipulation.seeing.depth_camera import DepthCamera, camera_rotation
from deformable_manipulation.seeing.live_map import LiveMap, Seen
from deformable_manipulation.seeing.seen_obstacles import live_obstacles

_ADVICE = (
    "change the camera's position, target, nearest or farthest, or the obstacle's least_points"
)


class Sight:
    """The scenario's camera and the live obstacles of its topic, in lock-step with the run.

    An image of a cycle is known in the next one, as with the nodes. Obstacles of other topics are
    never seen: without ROS nobody publishes them.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario: Scenario):
        self._camera = DepthCamera(scenario) if scenario.camera else None
        self._maps = {
            index: LiveMap(scenario, index)
            for index in live_obstacles(scenario)
            if is_of_camera(scenario, index)
        }
        self._refusals: Dict[int, str] = {}  # why the newest image is not used, by indices
        if scenario.camera:
            self._times = CameraTimes(scenario)
            self._pose = scenario.camera.position, camera_rotation(scenario.camera)

    def look(self, cycle: int, state: CarriedState) -> None:
        """Take an image of a cycle, if one is due."""
        if self._camera is None or not self._maps or not self._times.is_due(cycle):
            return
        points = self._camera.image(cycle, state)
        for index, each in self._maps.items():
            self._refusals.pop(index, None)
            try:
                each.take(state.time, points, self._pose, state, None)
            except ValueError as error:
                self._refusals[index] = str(error)  # it is lost when the time has come

    def seen(self) -> Dict[int, Seen]:
        """What is known of the live obstacles, by their indices."""
        return {index: each.seen for index, each in self._maps.items() if each.seen is not None}

    def fault(self, time: float) -> str:
        """Which obstacles are not known at a time [s], as a clause; empty: all are."""
        faults = (self._lost(index, each.fault(time)) for index, each in self._maps.items())
        return ", ".join(filter(None, faults))

    def refusal(self, index: int) -> str:
        """Why the newest image tells nothing of an obstacle, and what to change; empty: it does."""
        refusal = self._refusals.get(index)
        return f"the newest image is not used: {refusal}; {_ADVICE}" if refusal else ""

    def _lost(self, index: int, fault: str) -> str:
        told = lost(self._maps[index], fault)
        refusal = self.refusal(index)
        return f"{told}, {refusal}" if told and refusal else told


def lost(live_map: LiveMap, fault: str, origin: str = "") -> str:
    """A clause that says which obstacle is lost, and why; empty if there is no fault."""
    where = origin or f"on {live_map.spec.topic}"
    return fault and f"obstacle '{live_map.spec.name}' is lost: {fault} {where}"


def is_of_camera(scenario: Scenario, index: int) -> bool:
    """Whether a live obstacle's data come from the scenario's own camera."""
    spec = scenario.obstacles[index]
    return scenario.camera is not None and getattr(spec, "topic", None) == scenario.camera.topic
