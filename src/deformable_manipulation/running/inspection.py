"""A summary of a correct scenario at its start, and values that are probably not intended."""

from dataclasses import dataclass
from itertools import combinations
from typing import Iterator, Tuple

import numpy as np

from deformable_manipulation.control.overload import refuse_overloads
from deformable_manipulation.control.team import TeamController, teams
from deformable_manipulation.distance.factory import make_known_distance
from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.obstacles.spec import obstacle_corners
from deformable_manipulation.reading.parameter import declared
from deformable_manipulation.reading.readers import Number
from deformable_manipulation.running.true_distance import TrueDistance
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.seen_obstacles import live_obstacles
from deformable_manipulation.seeing.sight import Sight
from deformable_manipulation.simulation.factory import make_simulation
from deformable_manipulation.simulation.observer import Observer
from deformable_manipulation.worlds.factory import make_world, true_scenario

_LENGTHS = ("offset", "margin")  # that barriers keep
_SIZES_APART = 100.0  # times the object: an obstacle of that size is probably in another unit
_LARGE_PERTURBATION = 0.25  # of the free length between two agents
_LARGE_MARGIN = 0.05  # of the free length between two agents
_PATH_SAMPLES = 1000  # between waypoints, of which there are not many
_ROUNDING = 1.0 + 1e-6
_RESTS = {"stable": "at rest", "moving": "in motion", "balanced": "in an unstable balance"}


@dataclass(frozen=True)
class Inspection:
    """Facts worth knowing before a run, and values that are allowed but probably not intended."""

    facts: Tuple[str, ...]
    warnings: Tuple[str, ...]


def inspect_scenario(scenario: Scenario) -> Inspection:
    """Let the object settle between the agents, and look at it, the obstacles and the path.

    Raises:
        _pbd.ParameterError: the object does not settle.
        ValueError: an obstacle's shape is invalid.
        ScenarioError: the object at rest bears more than a limit allows.
        WorldError: the engine of ``knowledge.world`` is missing.
        RuntimeError: its simulation broke down.
    """
    simulation = make_simulation(scenario, copies=False)
    points = simulation.points()
    truth = TrueDistance(scenario, simulation)
    start = truth.of(points[:1])
    size = float(np.ptp(points[0], axis=0).max())
    facts, warnings = [], list(truth.warnings)
    facts.append("at the start the object reaches from {} to {} m".format(*_bounds(points[0])))
    warnings += filter(None, (simulation.rest_warning, simulation.softness))
    for obstacle in scenario.obstacles:
        if obstacle.is_live:
            warnings += _unseen_near_grips(scenario, obstacle)
            continue
        corners = obstacle_corners(obstacle)
        facts.append(_extent_of(obstacle, corners))
        if not obstacle.endless:
            warnings += _unlikely_size(obstacle, corners, size)
    if scenario.obstacles:
        facts.append("distance from the obstacles at the start: {:.4g} m".format(start))
    sight = Sight(scenario) if live_obstacles(scenario) else None
    observer = Observer(scenario, simulation, make_known_distance(scenario), False, sight)
    observer.look()  # as in the first cycle, after which the controllers see obstacles
    facts += _barriers(scenario, observer)
    if sight is not None:
        warnings += _unseen(scenario, sight)
    if not scenario.knowledge.perfect:
        facts.append(_true_object(scenario))
    warnings += _start_too_near(scenario, start)
    warnings += _path_warnings(scenario)
    warnings += _margin_warnings(scenario)
    warnings += scenario.object.warnings()
    return Inspection(tuple(facts), tuple(warnings))


def _true_object(scenario: Scenario) -> str:
    """What simulates the true object, and how it rests at the start; its engine must be there."""
    truth = true_scenario(scenario)
    world = make_world(truth, copies=False)
    return "the true object, in the world {}, has {} particles and starts {}".format(
        scenario.knowledge.world, truth.object.particles, _RESTS[world.rest]
    )


def _bounds(points: np.ndarray) -> Tuple[str, str]:
    low, high = points.min(axis=0), points.max(axis=0)
    return _place(low), _place(high)


def _place(point: np.ndarray) -> str:
    return "({})".format(", ".join("{:.4g}".format(value + 0.0) for value in np.round(point, 6)))


def _extent_of(obstacle, corners: np.ndarray) -> str:
    low, high = _bounds(corners)
    endless = obstacle.endless and ", " + obstacle.endless
    return "obstacle {} reaches from {} to {} m{}".format(obstacle.name, low, high, endless)


def _barriers(scenario: Scenario, observer: Observer) -> Iterator[str]:
    """Each barrier in use: its limits, and the h of each assistant at the start, as it knows it."""
    observation = observer.observe()
    starts = {}
    for names in teams(scenario):
        starts.update(TeamController(scenario, names, False).update(observation))
    refuse_overloads({name: decision.h for name, decision in starts.items()})
    for name in scenario.controller.barriers:
        section = getattr(scenario.controller, name)
        kind = BARRIERS[name]
        facts = [
            "{} {:g} {}".format(key, getattr(section, attribute), declaration.reader.unit)
            for key, (attribute, declaration) in declared(section).items()
            if key in _LENGTHS or (kind.is_load and isinstance(declaration.reader, Number))
        ]
        values = [
            "{} {:.4g} {}".format(agent, decision.h[name], kind.unit)
            for agent, decision in starts.items()
            if np.isfinite(decision.h[name])
        ]
        start = ", ".join(values) if values else "nothing to keep from"
        yield "barrier {}: {}; h at the start: {}".format(name, ", ".join(facts), start)


def _unlikely_size(obstacle, corners: np.ndarray, size: float) -> Iterator[str]:
    largest = float(np.ptp(corners, axis=0).max())
    if largest > _SIZES_APART * size:
        yield (
            "obstacle {}: it is {:.4g} m long, {:.0f} times as long as the object. If its file is "
            "in millimetres, use a scale of 0.001".format(obstacle.name, largest, largest / size)
        )
    elif largest * _SIZES_APART < size:
        yield (
            "obstacle {}: it is only {:.4g} m long, and the object {:.4g} m. Check the unit of its "
            "file, and its scale".format(obstacle.name, largest, size)
        )


def _start_too_near(scenario: Scenario, start: float) -> Iterator[str]:
    offset = scenario.controller.collision.offset
    if start < offset:
        yield (
            "the object starts {:.1f} mm from the obstacles, closer than "
            "controller.collision.offset, {:.1f} mm (negative: inside)".format(
                1e3 * start, 1e3 * offset
            )
        )


def _unseen(scenario: Scenario, sight: Sight) -> Iterator[str]:
    """Obstacles of which the simulated camera shows nothing at the start."""
    for index in live_obstacles(scenario):
        refusal = sight.refusal(index)
        if refusal:
            yield "obstacle {}: {}. The assistants stand still until it is seen".format(
                scenario.obstacles[index].name, refusal
            )


def _unseen_near_grips(scenario: Scenario, obstacle) -> Iterator[str]:
    offset = scenario.controller.collision.offset
    if obstacle.leave_out.grips >= offset > 0.0:
        yield (
            "obstacle {}: leave_out.grips is {:g} m. What is nearer to a held point is not seen, "
            "although controller.collision.offset is {:g} m".format(
                obstacle.name, obstacle.leave_out.grips, offset
            )
        )


def _path_warnings(scenario: Scenario) -> Iterator[str]:
    waypoints = scenario.leader.waypoints
    end = waypoints[-1].time
    if scenario.simulation.duration < end:
        yield (
            "simulation.duration: the run ends after {:g} s, before the leader's path, which takes "
            "{:g} s".format(scenario.simulation.duration, end)
        )
    path = LeaderPath(waypoints)
    times = np.linspace(waypoints[0].time, end, _PATH_SAMPLES)
    fastest = max(float(np.abs(path.velocity(time)).max()) for time in times)
    limit = scenario.controller.max_velocity
    if fastest > limit * _ROUNDING:
        yield (
            "leader.waypoints: a component of the leader's velocity reaches {:.3g} m/s; assistants "
            "reach {:.3g} m/s (controller.max_velocity) and fall behind".format(fastest, limit)
        )


def _margin_warnings(scenario: Scenario) -> Iterator[str]:
    """Lengths whose defaults suit objects of some metres."""
    agents = scenario.agents
    lengths = [
        scenario.object.free_length(first.particle, second.particle)
        for first, second in combinations(agents, 2)
    ]
    if not lengths:
        return
    shortest = min(lengths)
    controller = scenario.controller
    perturbation = max(map(abs, controller.perturbation))
    if perturbation > _LARGE_PERTURBATION * shortest:
        yield (
            "controller.perturbation: {:g} m is large compared with the {:.3g} m of object between "
            "two agents. A tenth of that length gives more local gradients".format(
                perturbation, shortest
            )
        )
    for name in controller.barriers:
        margin = getattr(getattr(controller, name), "margin", 0.0)
        if margin > _LARGE_MARGIN * shortest:
            yield (
                "controller.{}.margin: {:g} m is large compared with the {:.3g} m of object "
                "between two agents".format(name, margin, shortest)
            )
