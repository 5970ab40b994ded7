"""What commands that run a scenario without ROS cannot do."""

import sys

from deformable_manipulation.motion.obstacle_motion import names_without_path
from deformable_manipulation.scenario.spec import Scenario


def warn_of_standing_obstacles(command: str, scenario: Scenario) -> None:
    """Tell on stderr which obstacles stand, because a topic or tf would have to move them."""
    for name in names_without_path(scenario):
        print(
            f"{command}: WARNING: obstacle {name!r} stands at its own pose: its motion comes from "
            "ROS; start the launch file instead, or give it waypoints",
            file=sys.stderr,
        )
