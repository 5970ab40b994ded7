"""What commands that run a scenario without ROS cannot do."""

import sys

from deformable_manipulation.motion.obstacle_motion import names_without_path
from deformable_manipulation.scenario.spec import Scenario


def warn_of_standing_obstacles(command: str, scenario: Scenario) -> None:
    """Tell on stderr which obstacles stand, because a topic or tf would have to move them."""
    for name in names_without_path(scenario):
        print(
            f"{command}: WARNING: obstacle {name!r} stands still: its motion comes from ROS. Use "
            "the launch file, or give the obstacle waypoints",
            file=sys.stderr,
        )
