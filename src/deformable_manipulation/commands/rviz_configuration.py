"""The command ``rviz_configuration``: an RViz configuration whose views hold a scenario's run."""

import argparse
import sys
from typing import Optional, Sequence

from deformable_manipulation.authoring.rviz_configuration import rviz_configuration_text
from deformable_manipulation.commands.arguments import add_scenario_arguments
from deformable_manipulation.scenario import ScenarioError, load_scenario

_EXAMPLES = """\
examples:
  rviz_configuration my_scenario.yaml > my_scenario.rviz
  roslaunch deformable_manipulation run.launch scenario:=$PWD/my_scenario.yaml \\
      rviz_config:=$PWD/my_scenario.rviz

exit status: 0 printed, 1 mistakes in the scenario (listed on stderr), 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    parser = argparse.ArgumentParser(
        prog="rviz_configuration",
        description="Print an RViz configuration for a scenario: its displays, and the views "
        "Perspective, YZ and XY, which hold the whole path.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_scenario_arguments(parser)
    arguments = parser.parse_args(argv)
    try:
        scenario = load_scenario(arguments.scenario, arguments.set)
    except ScenarioError as error:
        print(error, file=sys.stderr)
        return 1
    sys.stdout.write(rviz_configuration_text(scenario))
    return 0


if __name__ == "__main__":
    sys.exit(main())
