"""The command ``check_scenario``: is a scenario file correct, and what does it hold."""

import argparse
import sys
from itertools import combinations
from typing import Iterator, Optional, Sequence

from deformable_manipulation.commands.arguments import (
    add_scenario_arguments,
    add_world_argument,
    scenario_overrides,
)
from deformable_manipulation.commands.copied_name import name_warning
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.last_word import say_after_parent
from deformable_manipulation.commands.launch_arguments import (
    add_launch_arguments,
    launch_problems,
)
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.scenario.limits import pair_limits
from deformable_manipulation.scenario.loader import load_scenario
from deformable_manipulation.scenario.mapping import scenario_to_yaml
from deformable_manipulation.scenario.spec import (
    PathMotion,
    Scenario,
    TopicMotion,
)

_EXAMPLES = """\
examples:
  check_scenario rope_one_assistant             a scenario of this package, by its name
  check_scenario my_scenario.yaml               a file
  check_scenario my_scenario.yaml --set controller.gain=2 --set leader.waypoints.1.time=12
  check_scenario my_scenario.yaml --world mujoco    with another engine's object
  check_scenario --resolved my_scenario.yaml    with every default filled in and file read

exit status: 0 correct, 1 mistakes (listed on stderr), 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parser().parse_args(argv)
    try:
        scenario = load_scenario(arguments.scenario, scenario_overrides(arguments) + arguments.sets)
        problems = list(launch_problems(arguments, scenario))
        if problems:
            raise ScenarioError(problems, "launch arguments")
    except ScenarioError as error:
        if arguments.last_word:
            say_after_parent(str(error))
        else:
            print(error, file=sys.stderr)
        return 1
    misnamed = name_warning(scenario, arguments.scenario)
    if misnamed:
        print("check_scenario: WARNING: {}".format(misnamed), file=sys.stderr)
    if arguments.resolved:
        sys.stdout.write(scenario_to_yaml(scenario))
    else:
        return _tell(scenario, arguments.scenario)
    return 0


def _tell(scenario: Scenario, given: str) -> int:
    """Print what the scenario holds and what is unlikely in it; returns the exit status."""
    # Imported late: loads the compiled core, which error messages do not need.
    from deformable_manipulation.running.inspection import inspect_scenario

    try:
        inspection = inspect_scenario(scenario)
    except (ValueError, RuntimeError) as error:
        return fail("check_scenario", "the scenario cannot be simulated: {}".format(error))
    print("{}: correct".format(given))
    for line in (*summary(scenario), *inspection.facts):
        print("  {}".format(line))
    for warning in inspection.warnings:
        print("check_scenario: WARNING: {}".format(warning), file=sys.stderr)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="check_scenario",
        description="Check a scenario file. List all its mistakes at once. If there are none, "
        "describe the scenario at its start, and warn of values that are probably not intended.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_scenario_arguments(parser)
    add_world_argument(parser)
    parser.add_argument(
        "--resolved",
        action="store_true",
        help="print only the scenario, as YAML with everything filled in",
    )
    add_launch_arguments(parser)
    return parser


def describe_obstacle(spec) -> str:
    """What kind of obstacle it is, in a few words."""
    shape = spec.description()
    return shape if spec.motion is None else "{}, {}".format(shape, describe_motion(spec.motion))


def describe_motion(motion) -> str:
    """Where an obstacle's pose comes from, in a few words."""
    if isinstance(motion, PathMotion):
        waypoints = motion.waypoints
        return "moves through {} waypoints, {:g} s".format(len(waypoints), waypoints[-1].time)
    if isinstance(motion, TopicMotion):
        return "pose from topic {}".format(motion.topic)
    return "pose of tf frame {}".format(motion.frame)


def describe_controller(controller, assistants: int) -> str:
    """How the assistants decide, in a few words."""
    parts = ["{} formulation".format(controller.formulation)]
    if assistants > 1:
        parts.append(controller.cooperation)
    if controller.horizon.length > 0.0:
        parts.append("looks {:g} s ahead".format(controller.horizon.length))
    return "controller: {}".format(", ".join(parts))


def _particles(agent) -> str:
    further = ", ".join(map(str, agent.further_particles))
    return "particle {}{}".format(agent.particle, further and " with " + further)


def summary(scenario: Scenario) -> Iterator[str]:
    """Lines that tell what a scenario holds."""
    yield "object: {}".format(scenario.object.description())
    yield "material: {}".format(scenario.object.material_description())
    for agent in scenario.agents:
        yield "agent {}: {}, holds {} ({}), starts at ({})".format(
            agent.name,
            agent.role,
            _particles(agent),
            agent.hold,
            ", ".join("{:.4g}".format(c) for c in agent.start),
        )
    for i, j in combinations(range(len(scenario.agents)), 2):
        limits = pair_limits(scenario, i, j)
        yield "distance between {} and {}: {:.4g} to {:.4g} m".format(
            scenario.agents[i].name,
            scenario.agents[j].name,
            limits.min_distance,
            limits.max_distance,
        )
    for obstacle in scenario.obstacles:
        yield "obstacle {}: {}".format(obstacle.name, describe_obstacle(obstacle))
    yield "distance to keep from obstacles: {:g} m".format(scenario.controller.collision.offset)
    yield describe_controller(scenario.controller, len(scenario.assistants))
    waypoints = scenario.leader.waypoints
    yield "leader's path: {} waypoint{}, {:g} s".format(
        len(waypoints), "" if len(waypoints) == 1 else "s", waypoints[-1].time
    )
    yield "duration: {:g} s, {} cycles at {:g} Hz".format(
        scenario.simulation.duration, scenario.cycles, scenario.controller.rate
    )
