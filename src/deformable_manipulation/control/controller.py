"""The safe velocity controller of one assistant."""

import time
from dataclasses import replace

import numpy as np

from deformable_manipulation.control.barriers import Situation, Tier
from deformable_manipulation.control.collision import CollisionBarrier
from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.differences import Differences
from deformable_manipulation.control.observation import find_fault
from deformable_manipulation.control.overstretch import OverstretchBarrier
from deformable_manipulation.control.proximity import ProximityBarrier
from deformable_manipulation.control.safety_filter import SafetyFilter
from deformable_manipulation.control.sensitivities import exact_features
from deformable_manipulation.control.status import Status
from deformable_manipulation.control.velocity_estimator import VelocityEstimator
from deformable_manipulation.scenario import pair_limits


class AssistantController:
    """Follows the leader at a fixed relative position, as far as the barriers allow.

    The command computed from state k acts from state k + 1 to k + 2. So everything is predicted
    for state k + 1 to first order: the own held point moves with the command decided from state
    k - 1, the others with their measured velocities. The nominal law is

        u_nom = k_p e + v_leader,  e = x_leader + reference - x  at state k + 1,

    whose error decays by (1 - k_p / rate) per cycle whatever the delay, and is zero behind a
    leader of constant velocity. Decentralised: it uses its own observations alone.

    Attributes:
        enabled: False answers every state with zero velocity.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        agent: name of the assistant.
        safety: False leaves the barriers out: the nominal velocity within its limits.

    Raises:
        ValueError: the scenario has no assistant of that name, or an unusable setting.
    """

    def __init__(self, scenario, agent, safety=True):
        self.enabled = True
        self._name = agent
        self._agent = _index_of(scenario, agent)
        self._leader = scenario.leader_index
        self._safety = safety
        self._settings = scenario.controller
        self._cycle_time = scenario.cycle_time
        starts = np.array([each.start for each in scenario.agents], dtype=float)
        self._start_reference = starts[self._agent] - starts[self._leader]
        self._agents = len(starts)
        self._velocities = VelocityEstimator(jump_back=scenario.controller.timeout)
        self._differences = Differences(self._agents, self._leader)
        self._filter = SafetyFilter(scenario.controller.weights, scenario.controller.solver)
        self._make_barriers(scenario)
        self.reset()

    def _make_barriers(self, scenario):
        settings, agent, leader = scenario.controller, self._agent, self._leader
        limits = [pair_limits(scenario, agent, j) if j != agent else None
                  for j in range(self._agents)]
        longest = [limit.max_distance if limit else 0.0 for limit in limits]
        shortest = [limit.min_distance if limit else 0.0 for limit in limits]
        self._collision = CollisionBarrier(
            agent,
            scenario.assistants,
            settings.collision.offset,
            settings.collision.alpha,
            settings.feedforward,
        )
        self._overstretch = OverstretchBarrier(agent, leader, longest, settings.overstretch.alpha)
        self._proximity = ProximityBarrier(agent, leader, shortest, settings.proximity.alpha)

    def reset(self):
        """Back to the start: forget all states and take the scenario's reference again."""
        self._reference = self._start_reference
        self._forget()

    def _forget(self):
        self._velocities.reset()
        self._differences.reset()
        self._command = np.zeros(3)
        self._time = None
        self._last = None

    def take_reference(self, observation):
        """Follow the leader at the present relative position from now on.

        Raises:
            ValueError: the observation is not valid; the message names the field.
        """
        fault = find_fault(observation, self._agents)
        if fault:
            raise ValueError(fault)
        positions = observation.positions
        self._reference = positions[self._agent] - positions[self._leader]

    def update(self, observation):
        """Decide the velocity for one state.

        A state that is not newer than the last one gets the same answer again; one that is older
        by more than the timeout means that time was set back, and starts afresh.

        Args:
            observation: :class:`~.observation.Observation`.

        Returns:
            :class:`~.decision.Decision`
        """
        started = time.perf_counter()
        fault = find_fault(observation, self._agents)
        if fault:
            decision = self.wait(fault)
        elif self._is_answered(observation.time):
            return self._last
        else:
            decision = self._decide(observation)
        self._command = decision.command
        self._last = replace(decision, computation_time=time.perf_counter() - started)
        return self._last

    def wait(self, reason):
        """Stand still because an input is missing or unusable.

        Args:
            reason: a clause that says what is wrong, without a full stop.

        Returns:
            :class:`~.decision.Decision` with zero velocity and status WAITING.
        """
        self._command = np.zeros(3)
        return self._stopped(Status.WAITING, f"Waits, zero velocity: {reason}.")

    def _is_answered(self, stamp):
        if self._time is None:
            return False
        if stamp < self._time - self._settings.timeout:
            self._forget()
            return False
        return stamp <= self._time and self._last.enabled == self.enabled

    def _stopped(self, status, text, **known):
        return Decision(
            status=status, text=text, enabled=self.enabled, command=np.zeros(3), **known
        )

    def _decide(self, observation):
        if self._time is None or observation.time > self._time:
            self._time = observation.time
        self._velocities.update(observation.time, observation.positions)
        self._differences.update(observation)
        situation = self._predict(observation)
        nominal = self._nominal(situation)
        known = self._known(observation, nominal)
        if not self.enabled:
            return self._stopped(Status.DISABLED, Status.DISABLED.sentence, **known)
        exact = self._is_exact(observation)
        known["exact_jacobian"] = exact
        features = self._features(observation, exact)
        usable = exact or self._differences.known(self._agent)
        if self._safety and len(features.distance) and not usable:
            text = f"Waits, zero velocity: the state has no ready perturbed copies of {self._name}."
            return self._stopped(Status.WAITING, text, **known)
        known.update(self._sensitivity(features, situation))
        if not self._safety:
            return self._unfiltered(nominal, known)
        return self._filtered(nominal, features, situation, known)

    def _predict(self, observation):
        """The :class:`~.barriers.Situation` at the next state, when the command starts to act."""
        velocities = self._velocities.velocity().copy()
        velocities[self._agent] = self._command
        return Situation(
            positions=observation.positions + self._cycle_time * velocities,
            velocities=velocities,
            leader_velocity=velocities[self._leader],
            delay=self._cycle_time,
        )

    def _nominal(self, situation):
        positions = situation.positions
        error = positions[self._leader] + self._reference - positions[self._agent]
        nominal = self._settings.gain * error
        return nominal + situation.leader_velocity if self._settings.feedforward else nominal

    def _known(self, observation, nominal):
        """What the decision says about the present state, whatever the command."""
        positions = observation.positions
        target = positions[self._leader] + self._reference
        distance = float(observation.distances.minimum[0])
        return {
            "nominal": nominal,
            "position": positions[self._agent],
            "target": target,
            "error": target - positions[self._agent],
            "distance": distance,
            "h_collision": self._collision.value(distance),
            "h_overstretch": float(self._overstretch.value(positions).min()),
            "h_proximity": float(self._proximity.value(positions).min()),
        }

    def _is_exact(self, observation):
        wanted = self._settings.jacobian == "equilibrium"
        return wanted and observation.sensitivities is not None

    def _features(self, observation, exact):
        minimum_only = self._settings.collision.gradient == "minimum"
        if exact:
            return exact_features(
                observation.distances, observation.sensitivities, self._leader, minimum_only
            )
        if minimum_only:
            return self._differences.minimum(observation.distances)
        return self._differences.features(observation.distances)

    def _sensitivity(self, features, situation):
        """How the minimum distance changes with this agent's and the leader's motion."""
        if not len(features.distance):
            return {"jacobian": np.zeros(3), "leader_drift": 0.0}
        gradients = features.gradients[0]
        return {
            "jacobian": gradients[self._agent],
            "leader_drift": float(gradients[self._leader] @ situation.leader_velocity),
        }

    def _bounds(self):
        """Velocities that the limits of velocity and acceleration allow in the next cycle."""
        step = self._settings.max_acceleration * self._cycle_time
        limit = self._settings.max_velocity
        return np.maximum(self._command - step, -limit), np.minimum(self._command + step, limit)

    def _unfiltered(self, nominal, known):
        lower, upper = self._bounds()
        command = np.minimum(np.maximum(nominal, lower), upper)
        if not np.isfinite(command).all():
            return self._stopped(Status.FAILED, Status.FAILED.sentence, **known)
        status = Status.UNSAFE_FILTER_OFF
        return Decision(
            status=status, text=status.sentence, enabled=True, command=command, **known
        )

    def _filtered(self, nominal, features, situation, known):
        rows = (
            self._collision.rows(features, situation),
            self._overstretch.rows(situation),
            self._proximity.rows(situation),
        )
        result = self._filter.filter(nominal, rows, *self._bounds())
        return Decision(
            status=result.status,
            text=_text(result),
            enabled=True,
            command=result.velocity,
            rows=result.rows,
            slack_collision=float(result.slack[Tier.COLLISION]),
            slack_overstretch=float(result.slack[Tier.OVERSTRETCH]),
            slack_proximity=float(result.slack[Tier.PROXIMITY]),
            solve_time=result.solve_time,
            **known,
        )


def _index_of(scenario, name):
    assistants = {scenario.agents[i].name: i for i in scenario.assistants}
    if name not in assistants:
        raise ValueError(
            f"agent: '{name}', allowed are the scenario's assistants: {', '.join(assistants)}"
        )
    return assistants[name]


def _text(result):
    if result.status != Status.RELAXED:
        return result.status.sentence
    amounts = ", ".join(
        f"{tier.name.lower()} by {result.slack[tier]:.4f} m/s"
        for tier in Tier
        if result.slack[tier]
    )
    return f"{result.status.sentence[:-1]}: {amounts}."
