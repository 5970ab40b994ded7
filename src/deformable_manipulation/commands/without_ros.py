"""What commands that run a scenario without ROS cannot do."""

import sys

from deformable_manipulation.motion.obstacle_motion import names_without_path
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.seen_obstacles import live_obstacles
from deformable_manipulation.seeing.sight import is_of_camera


def warn_of_standing_obstacles(command: str, scenario: Scenario) -> None:
    """Tell on stderr which obstacles stand or are not there, because ROS would have to tell."""
    for name in names_without_path(scenario):
        print(
            f"{command}: WARNING: obstacle {name!r} stands still: its motion comes from ROS. Use "
            "the launch file, or give the obstacle waypoints",
            file=sys.stderr,
        )
    for index in live_obstacles(scenario):
        if not is_of_camera(scenario, index):
            print(
                f"{command}: WARNING: nothing is there of obstacle "
                f"{scenario.obstacles[index].name!r}: its data come from ROS. Use the launch file, "
                "or give the scenario a camera with its topic",
                file=sys.stderr,
            )
