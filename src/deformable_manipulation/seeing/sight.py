"""What the controllers of a run without ROS see of live obstacles."""

from typing import Dict

from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.camera_times import CameraTimes
from deformable_manipulation.seeing.carried_state import CarriedState
from deformable_manipulation.seeing.depth_camera import DepthCamera, camera_rotation
from deformable_manipulation.seeing.live_map import LiveMap, Seen
from deformable_manipulation.seeing.seen_obstacles import live_obstacles


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
        if scenario.camera:
            self._times = CameraTimes(scenario)
            self._pose = scenario.camera.position, camera_rotation(scenario.camera)

    def look(self, cycle: int, state: CarriedState) -> None:
        """Take an image of a cycle, if one is due."""
        if self._camera is None or not self._maps or not self._times.is_due(cycle):
            return
        points = self._camera.image(cycle, state).reshape(-1, 3)
        for each in self._maps.values():
            try:
                each.take(state.time, points, self._pose, state, None)
            except ValueError:
                pass  # it is lost when the time has come, which fault() tells

    def seen(self) -> Dict[int, Seen]:
        """What is known of the live obstacles, by their indices."""
        return {index: each.seen for index, each in self._maps.items() if each.seen is not None}

    def fault(self, time: float) -> str:
        """Which obstacles are not known at a time [s], as a clause; empty: all are."""
        faults = (lost(each, each.fault(time)) for each in self._maps.values())
        return ", ".join(filter(None, faults))


def lost(live_map: LiveMap, fault: str, origin: str = "") -> str:
    """A clause that says which obstacle is lost, and why; empty if there is no fault."""
    where = origin or f"on {live_map.spec.topic}"
    return fault and f"obstacle '{live_map.spec.name}' is lost: {fault} {where}"


def is_of_camera(scenario: Scenario, index: int) -> bool:
    """Whether a live obstacle's data come from the scenario's own camera."""
    spec = scenario.obstacles[index]
    return scenario.camera is not None and getattr(spec, "topic", None) == scenario.camera.topic
