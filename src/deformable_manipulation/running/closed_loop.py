"""The whole chain in one process, without ROS: leader, simulation, distances, controllers."""

import time
from typing import Dict, Optional, Tuple

import numpy as np

from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.observation import Observation
from deformable_manipulation.control.overload import has_load_limits, refuse_overloads
from deformable_manipulation.control.team import TeamController, teams
from deformable_manipulation.distance.factory import make_known_distance, make_minimum_distance
from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.motion.leader import LeaderController, LeaderTurning
from deformable_manipulation.recording.timeseries import CycleRecord, CycleTimings
from deformable_manipulation.running.announcer import Announcer
from deformable_manipulation.running.imperfect import ImperfectKnowledge
from deformable_manipulation.running.true_distance import TrueDistance
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.seen_obstacles import live_obstacles
from deformable_manipulation.seeing.sight import Sight
from deformable_manipulation.simulation.observer import Observer
from deformable_manipulation.simulation.stretch import StretchGauge
from deformable_manipulation.worlds.factory import make_world, true_scenario

_PROGRESS_REPORTS = 100


class ClosedLoop:
    """Runs a scenario in lock-step: the same order and delay as the nodes (docs/interfaces.md).

    In cycle k all controllers answer state k, the simulation advances to state k + 1 with the
    commands of cycle k - 1, and then takes the new ones. Obstacles move along the scenario's paths;
    those whose poses come from a topic or from tf stay where the scenario puts them. The recorded
    distance is that from all obstacles that are there, known to the controllers or not.

    Raises:
        _pbd.ParameterError: a parameter of the scenario is out of the simulation's range.
        ScenarioError: the object at rest bears more than a limit allows.
        WorldError: the engine of ``knowledge.world`` is missing or has no such object.
    """

    def __init__(self, scenario: Scenario, safety: bool = True):
        self._scenario = scenario
        perfect = scenario.knowledge.sees_object
        # No gradients are needed without barriers; with imperfect knowledge the model has its own.
        copies = safety and perfect
        truth = true_scenario(scenario)
        self._simulation = make_world(truth, copies)
        self._sight = Sight(scenario) if live_obstacles(scenario) else None
        self._truth = TrueDistance(scenario, self._simulation)
        self._leader = LeaderController(scenario)
        self._turning = LeaderTurning(scenario)
        self._leader_index = scenario.leader_index
        self._announcer = Announcer(scenario, self._leader)
        self._intent: Optional[Intent] = None  # as announced with the state before
        self._controllers = [TeamController(scenario, names, safety) for names in teams(scenario)]
        known = make_known_distance(scenario)
        self._observer = Observer(scenario, self._simulation, known, perfect, self._sight)
        self._knowledge = None
        if not perfect:
            self._knowledge = ImperfectKnowledge(
                scenario, self._controllers, make_minimum_distance(scenario)
            )
        self._stretch = StretchGauge(truth.object)
        if safety and has_load_limits(scenario):
            refuse_overloads(self._margins())

    @property
    def rest(self) -> str:
        """How the object rests at the start: ``stable``, ``moving`` or ``balanced``."""
        return self._simulation.rest

    @property
    def warnings(self) -> Tuple[str, ...]:
        """Sentences about an unstable start and a stiffness that the substeps cannot keep."""
        simulation = self._simulation
        return tuple(filter(None, (simulation.rest_warning, simulation.softness)))

    def distance(self) -> float:
        """Present signed distance [m] of the object from the obstacles; infinite without any."""
        return self._truth.of(self._simulation.points()[:1])

    def run(self, recorder=None, progress=None) -> None:
        """Run the scenario to its end.

        ``recorder`` gets a :class:`CycleRecord` per cycle; ``progress`` is called about a hundred
        times with the fraction done.

        Raises:
            _pbd.NonFiniteState: the simulation broke down; its text says what happened.
        """
        cycles = self._scenario.cycles
        report_every = max(1, cycles // _PROGRESS_REPORTS)
        for cycle in range(cycles):
            record = self.step()
            if recorder is not None:
                recorder.record(record)
            if progress is not None and (cycle + 1) % report_every == 0:
                progress((cycle + 1) / cycles)

    def step(self) -> CycleRecord:
        """Answer the present state and advance to the next one."""
        simulation = self._simulation
        started = time.perf_counter()
        observation = self._observer.observe(self._intent)
        measured = time.perf_counter()
        decisions = self._decide(observation)
        leader = self._leader_index
        leader_velocity = self._leader.update(observation.time, observation.positions[leader])
        leader_turning = self._turn_leader(observation)
        self._intent = self._announcer.announce(observation.time)
        decided = time.perf_counter()
        velocities = simulation.velocities()
        points = observation.points[0].copy()
        distance = self._truth.in_observation(observation)
        self._observer.look()

        advancing = time.perf_counter()
        simulation.advance()
        simulation.set_command(leader, leader_velocity, leader_turning)
        for index in self._scenario.assistants:
            name = self._scenario.agents[index].name
            decision = decisions[name]
            simulation.set_command(index, decision.command, decision.angular_command)
        advanced = time.perf_counter()

        return CycleRecord(
            cycle=observation.cycle,
            time=observation.time,
            distance=distance,
            stretch=self._stretch.measure(points),
            positions=observation.positions,
            velocities=velocities,
            points=points,
            obstacles=self._observer.obstacle_poses(),
            model=self._knowledge.model if self._knowledge is not None else None,
            decisions=decisions,
            timings=CycleTimings(
                simulation=advanced - advancing,
                distance=measured - started,
                controller=decided - measured,
            ),
        )

    def _turn_leader(self, observation: Observation) -> np.ndarray:
        """The leader's angular velocity (3,) [rad/s]; zero where its path does not turn it."""
        if not self._turning.turns or observation.orientations is None:
            return np.zeros(3)
        return self._turning.update(observation.time, observation.orientations[self._leader_index])

    def _margins(self) -> Dict[str, Dict[str, float]]:
        """The present h of each barrier, of all assistants by their names."""
        # Without the response: looking for it once more would change the run by rounding.
        known = make_known_distance(self._scenario)
        observer = Observer(self._scenario, self._simulation, known, False)
        observation = observer.observe()
        return {
            name: controller.margins(name, observation)
            for controller in self._controllers
            for name in controller.names
        }

    def _decide(self, observation: Observation) -> Dict[str, Decision]:
        """The decisions of all assistants by their names."""
        if self._knowledge is not None:
            return self._knowledge.decide(observation)
        lost = self._sight.fault(observation.time) if self._sight else ""
        decisions = {}
        for controller in self._controllers:
            decisions.update(controller.wait(lost) if lost else controller.update(observation))
        return decisions
