"""Controllers that know the object and where it is held only imperfectly."""

import dataclasses
import math
from collections import deque
from typing import Dict, Optional, Sequence

import numpy as np

from deformable_manipulation._control import PositionFilter
from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.observation import Observation
from deformable_manipulation.reading.plain import plain
from deformable_manipulation.recording.timeseries import ModelRecord
from deformable_manipulation.running.camera import Camera
from deformable_manipulation.scenario.spec import KnowledgeSpec, Scenario
from deformable_manipulation.simulation.factory import make_simulation
from deformable_manipulation.simulation.observer import Observer

_LARGEST_SPEED = 2.0  # m/s, at which a model follows poses: PoseInbox::kMaxSpeed


class ImperfectController:
    """A controller that sees a model of the object instead of the object itself.

    Its decisions are reported with the true places, distances and margins.

    Args:
        scenario: the scenario as it is assumed to be.
        controller: TeamController.
        random: numpy's Generator, of the cycles that are dropped.
    """

    def __init__(self, scenario: Scenario, controller, random: np.random.Generator):
        self._controller = controller
        self._random = random
        self._dropped = scenario.knowledge.dropped_cycles
        self._timeout = scenario.controller.timeout
        self._answered = 0.0  # s, time of the newest state that arrived
        self._decisions = controller.wait("no state has arrived yet")
        self._truths = {
            scenario.agents[index].name: _Truth(scenario, index, controller)
            for index in scenario.assistants
            if scenario.agents[index].name in controller.names
        }

    def stop(self, truth: Observation) -> Dict[str, Decision]:
        """Decide to stop, because the model is not that of the object."""
        self._decisions = self._controller.wait("the model disagrees with the measured points")
        return self._told(truth)

    def update(self, seen: Observation, truth: Observation) -> Dict[str, Decision]:
        """Decide the velocities; if the state does not arrive, repeat the last commands."""
        if self._random.random() >= self._dropped:
            self._answered = seen.time
            self._decisions = self._controller.update(seen)
        elif seen.time - self._answered > self._timeout:
            self._decisions = self._controller.wait("no state has arrived for too long")
        return self._told(truth)

    def _told(self, truth: Observation) -> Dict[str, Decision]:
        return {
            name: self._truths[name].told(decision, truth)
            for name, decision in self._decisions.items()
        }


class _Truth:
    """Puts the true state of an assistant into its decisions."""

    def __init__(self, scenario: Scenario, index: int, controller):
        starts = np.array([agent.start for agent in scenario.agents])
        self._index, self._leader = index, scenario.leader_index
        self._name = scenario.agents[index].name
        self._reference = starts[index] - starts[self._leader]
        self._controller = controller

    def told(self, decision: Decision, truth: Observation) -> Decision:
        position = truth.positions[self._index]
        target = truth.positions[self._leader] + self._reference
        distance = float(truth.distances.minimum[0])
        return dataclasses.replace(
            decision,
            position=position,
            target=target,
            error=target - position,
            distance=distance,
            h=self._controller.margins(self._name, truth),
        )


class ImperfectKnowledge:
    """The model of the object that the controllers derive from the agents' measured poses.

    The model is a simulation with the scenario's material. Its held points follow the measured
    poses, filtered and predicted over their delay, as those of a simulator whose agents are
    ``driven_by: pose`` (src/ros/agent_link.h).

    Args:
        scenario: the scenario as it is assumed to be; its ``knowledge`` says what is wrong.
        controllers: TeamControllers of all assistants.
        distance: MinimumDistance or one like it, for the model.

    Attributes:
        model: what the controllers saw of the object in the last state, None before the first.
    """

    def __init__(self, scenario: Scenario, controllers: Sequence, distance):
        knowledge = scenario.knowledge
        self.model: Optional[ModelRecord] = None
        self._cycle_time = scenario.cycle_time
        self._model = make_simulation(scenario)
        self._observer = Observer(scenario, self._model, distance)
        self._poses = MeasuredPoses(
            self._model.positions(),
            knowledge,
            scenario.cycle_time,
            np.random.default_rng([knowledge.seed, 0]),
        )
        self._delay = knowledge.pose_delay
        self._stop = False
        self._camera = None
        if scenario.correction is not None:
            self._model.correct(plain(scenario.correction))
            self._stop = scenario.correction.stop
            if knowledge.camera_rate > 0.0:
                random = np.random.default_rng([knowledge.seed, 2])
                self._camera = Camera(knowledge, float(scenario.object.edges()[1].sum()), random)
        self._filter = PositionFilter(scenario.controller.pose_smoothing)
        drops = np.random.default_rng([knowledge.seed, 1])
        self._controllers = [
            ImperfectController(scenario, controller, drops) for controller in controllers
        ]

    def decide(self, truth: Observation) -> Dict[str, Decision]:
        """The decisions of all assistants on a state of which they get the measured poses.

        Args:
            truth: one state after the other, with the object's own distances.
        """
        self._filter.update(truth.time - self._delay, self._poses.measure(truth.positions))
        if truth.cycle > 0:
            self._follow(self._filter.position(truth.time))
        self._correct(truth)
        seen = dataclasses.replace(
            self._observer.observe(truth.intent), velocities=self._filter.velocity()
        )
        self.model = self._recorded(seen)
        stopped = self._stop and self._model.disagrees
        decisions = {}
        for controller in self._controllers:
            decisions.update(controller.stop(truth) if stopped else controller.update(seen, truth))
        return decisions

    def _correct(self, truth: Observation) -> None:
        """Show the model what the camera sees."""
        if self._camera is not None:
            picture = self._camera.look(truth.time, truth.points[0])
            if picture is not None:
                self._model.measure(picture.time, picture.points, picture.places)

    def _recorded(self, seen: Observation) -> ModelRecord:
        correction = 0.0
        if seen.correction is not None:
            correction = float(np.linalg.norm(seen.correction, axis=1).max())
        return ModelRecord(
            float(seen.distances.minimum[0]),
            seen.points[0].copy(),
            correction,
            self._model.disagrees,
        )

    def _follow(self, positions: np.ndarray) -> None:
        """Advance the model to the next state, with its held points going to ``positions``."""
        velocities = (positions - self._model.positions()) / self._cycle_time
        speeds = np.linalg.norm(velocities, axis=1, keepdims=True)
        velocities /= np.maximum(1.0, speeds / _LARGEST_SPEED)
        for agent, velocity in enumerate(velocities):
            self._model.set_command(agent, velocity)
        self._model.advance()


class MeasuredPoses:
    """The held points as they are measured: late and with noise."""

    def __init__(self, start: np.ndarray, knowledge: KnowledgeSpec, cycle_time: float, random):
        cycles = knowledge.pose_delay / cycle_time
        self._noise = knowledge.pose_noise
        self._random = random
        # States at both ends of the cycle in which the newest poses were measured.
        self._weight = math.ceil(cycles) - cycles
        self._states = deque([start] * (math.ceil(cycles) + 1), math.ceil(cycles) + 1)

    def measure(self, positions: np.ndarray) -> np.ndarray:
        """What arrives (A, 3) [m] with a state whose true held points are ``positions``."""
        self._states.append(positions)
        measured = self._states[0]
        if self._weight:  # held points move at constant velocity within a cycle
            measured = measured + self._weight * (self._states[1] - measured)
        return measured + self._noise * self._random.standard_normal(measured.shape)
