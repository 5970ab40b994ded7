"""Random variations of a scenario, each from its number alone."""

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from deformable_manipulation.campaign.leader_paths import PLACES, NoPath, random_path
from deformable_manipulation.campaign.reasons import Reasons
from deformable_manipulation.campaign.terrain import random_obstacles
from deformable_manipulation.control.overload import has_load_limits
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.motion.obstacle_motion import obstacle_places
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.running.true_distance import TrueDistance
from deformable_manipulation.scenario import scenario_from_mapping
from deformable_manipulation.scenario.mapping import scenario_to_mapping
from deformable_manipulation.scenario.spec import (
    KnowledgeSpec,
    Scenario,
)
from deformable_manipulation.simulation.factory import make_simulation

_ATTEMPTS = 100
_BOX_GROWTH = 0.1  # m, of the box that the scenario's own path is in
_START_SHIFT = 0.05  # m, of an assistant's start
_PLACES = 50  # of a moving obstacle on its way, which the leader's path keeps clear of
_MOST_NOISE = 0.002  # m, of imperfect knowledge: each up to this
_MOST_DELAY = 0.05  # s
_LARGEST_FACTOR = 2.0  # of the material, true over assumed or the other way
_MOST_DROPS = 0.2
_SPARE = 0.05  # m, beyond the offset, that the object is clear at the start


class NoVariation(RuntimeError):
    """No random variation of a scenario was found that can be started."""


@dataclass(frozen=True)
class Ranges:
    """What is random in a campaign, and how much."""

    speed: float = 0.1  # m/s, that no component of the leader's velocity exceeds
    path: str = PLACES  # kind of the leader's path, or DIVES
    duration: float = 90.0  # s
    clearance: float = 0.25  # m, that the leader's grip keeps from the obstacles
    material: float = 1.5  # stiffness and weight are changed by up to this factor
    terrain: bool = True  # False: the scenario's own obstacles
    imperfect: bool = False  # True: what the controllers know is wrong, by random amounts


def vary(scenario: Scenario, ranges: Ranges, seed: int, index: int) -> Scenario:
    """The variation of a scenario that belongs to a seed and the number of the run.

    It depends on nothing else: not on who makes it, nor on the runs before.

    Raises:
        NoVariation: none was found that can be started.
    """
    reasons = Reasons()
    for attempt in range(_ATTEMPTS):
        random = np.random.default_rng([seed, index, attempt])
        try:
            varied = _checked(_draw(scenario, ranges, random), index)
        except (NoPath, ScenarioError) as error:
            reasons.add(error)
            continue
        problem = _problem_at_start(varied)
        if not problem:
            return varied
        reasons.add(problem)
    raise NoVariation(
        f"run {index}: none of {_ATTEMPTS} random variations can be started; {reasons}"
    )


def _draw(scenario: Scenario, ranges: Ranges, random) -> Scenario:
    obstacles = scenario.obstacles
    if ranges.terrain:
        obstacles = random_obstacles(obstacles, random)
    drawn = dataclasses.replace(
        scenario,
        object=scenario.object.with_random_material(lambda: _factor(ranges.material, random)),
        obstacles=obstacles,
        agents=tuple(_other_start(agent, random) for agent in scenario.agents),
        simulation=dataclasses.replace(scenario.simulation, duration=ranges.duration),
    )
    low, high = _box(scenario)
    start = np.array(drawn.agents[drawn.leader_index].start)
    clearance = _clearance(drawn)
    path = random_path(
        random,
        low,
        high,
        ranges.speed,
        ranges.duration,
        lambda points: clearance(start + points),
        ranges.clearance,
        ranges.path,
    )
    leader = dataclasses.replace(drawn.leader, waypoints=tuple(path))
    drawn = dataclasses.replace(drawn, leader=leader)
    # Last, so that the rest of a run is the same with it and without.
    if not ranges.imperfect:
        return drawn
    return dataclasses.replace(drawn, knowledge=_knowledge(drawn.knowledge, random))


def _knowledge(given: KnowledgeSpec, random) -> KnowledgeSpec:
    """The scenario's own knowledge, with random amounts of what is wrong."""
    return dataclasses.replace(
        given,
        pose_noise=random.uniform(0.0, _MOST_NOISE),
        pose_delay=random.uniform(0.0, _MOST_DELAY),
        stiffness_factor=_factor(_LARGEST_FACTOR, random),
        density_factor=_factor(_LARGEST_FACTOR, random),
        dropped_cycles=random.uniform(0.0, _MOST_DROPS),
        seed=int(random.integers(2**31)),
    )


def _checked(scenario: Scenario, index: int) -> Scenario:
    """The scenario as its file would be read. Raises ScenarioError."""
    named = dataclasses.replace(scenario, name=f"{scenario.name}_{index:05d}")
    return scenario_from_mapping(scenario_to_mapping(named), ".")


def _box(scenario: Scenario):
    """Corners [m] of the box around the scenario's own path, relative to the leader's start."""
    path = np.array([waypoint.position for waypoint in scenario.leader.waypoints])
    return path.min(axis=0) - _BOX_GROWTH, path.max(axis=0) + _BOX_GROWTH


def _other_start(agent, random):
    """The leader starts where it is; an assistant near its place."""
    if agent.role == "leader":
        return agent
    shift = random.uniform(-_START_SHIFT, _START_SHIFT, 3)
    return dataclasses.replace(agent, start=tuple((np.array(agent.start) + shift).tolist()))


def _factor(largest: float, random) -> float:
    """Between 1 / largest and largest, as likely to lessen as to enlarge."""
    return math.exp(random.uniform(-1.0, 1.0) * math.log(largest))


def _clearance(scenario: Scenario):
    """Distances (N,) [m] of points (N, 3) from the scenario's obstacles, less the object's size.

    Those that move are everywhere on their way.
    """
    everywhere = [
        place for obstacle in scenario.obstacles for place in obstacle_places(obstacle, _PLACES)
    ]
    distance = MinimumDistance(everywhere, scenario.object.margin)

    def clearance(points):
        # Each point as a copy of a polyline that is nowhere else.
        return distance.compute(np.repeat(points[:, None], 2, axis=1)).minimum

    return clearance


def _problem_at_start(scenario: Scenario) -> str:
    """Why nobody would start so; empty: it is fine."""
    simulation = make_simulation(scenario)
    lowest = TrueDistance(scenario, simulation).of(simulation.points()[:1])
    if lowest < scenario.controller.collision.offset + _SPARE:
        return "the object starts too close to the obstacles"
    if has_load_limits(scenario):
        try:
            ClosedLoop(scenario)
        except ScenarioError as error:
            return str(error)
    return ""
