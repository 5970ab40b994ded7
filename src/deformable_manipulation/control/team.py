"""The safe velocity controller of one or several assistants; centralised if it commands all."""

import time

from deformable_manipulation import _control
from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.forecast import Forecast
from deformable_manipulation.control.observation import wrong_type
from deformable_manipulation.control.parameters import native_parameters
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.control.status import Status
from deformable_manipulation.scenario.controller import CENTRALISED

_STATUSES = sorted(Status)


def teams(scenario, names=None):
    """Names of the assistants whose velocities are decided together, a tuple per controller.

    ``controller.cooperation`` says which: each assistant alone, or all in one program.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        names: of the assistants; default: all of the scenario.
    """
    if names is None:
        names = [scenario.agents[index].name for index in scenario.assistants]
    if scenario.controller.cooperation == CENTRALISED:
        return (tuple(names),)
    return tuple((name,) for name in names)


class TeamController:
    """Lets assistants follow the leader at fixed relative positions, as far as the barriers allow.

    One quadratic program over the velocities of all of them (docs/mathematics.md). The command
    computed from state k acts from state k + 1 to k + 2, and everything is predicted for state
    k + 1. The mathematics is in the C++ core, ``_control.TeamController``.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        names: of the assistants.
        safety: False leaves the barriers out: the nominal velocities within their limits.

    Raises:
        ValueError: the scenario has no assistant of a name, or an unusable setting.
    """

    def __init__(self, scenario, names, safety=True):
        self._safety = safety
        self._members = {name: number for number, name in enumerate(names)}
        self._barriers = scenario.controller.barriers
        self._native = _control.TeamController(
            *native_parameters(scenario, names, safety), find_solver(scenario.controller.solver)
        )
        self._last = None
        self._forecast = None
        if safety and scenario.controller.horizon.length > 0.0:
            self._forecast = Forecast(scenario)
            self._native.look_ahead(
                self._forecast.shapes, self._forecast.distance, self._forecast.triangles
            )

    @property
    def names(self):
        """Of the assistants that it commands, in order."""
        return tuple(self._members)

    def is_enabled(self, name):
        """Whether an assistant follows; if not, it slows down to rest, and the others know."""
        return self._native.is_enabled(self._members[name])

    def set_enabled(self, name, enabled):
        """Let an assistant follow, or stand still."""
        self._native.set_enabled(self._members[name], enabled)

    def set_parameters(self, scenario):
        """Continue with the gains, limits and margins of another scenario of the same agents.

        Observations and references stay, and so do ``formulation``, ``priority``, ``solver`` and
        the barriers in use.

        Raises:
            ValueError: they cannot be used; nothing changes then.
        """
        self._native.set_parameters(*native_parameters(scenario, self.names, self._safety))

    def reset(self):
        """Go back to the start: forget all states and use the scenario's references again."""
        self._native.reset()

    def take_reference(self, name, observation):
        """Let an assistant follow the leader at its present relative position from now on.

        Raises:
            ValueError: the observation is not valid; the message names the field.
        """
        fault = wrong_type(observation)
        if fault:
            raise ValueError(fault)
        self._native.take_reference(self._members[name], observation)

    def update(self, observation):
        """Decide the velocities for one state.

        A state that is not newer than the last one gets the same answer again. If it is older by
        more than the timeout, time was set back: the controller starts again.

        Args:
            observation: :class:`~.observation.Observation`.

        Returns:
            A :class:`~.decision.Decision` for each assistant by its name.
        """
        started = time.perf_counter()
        fault = wrong_type(observation)
        if fault:
            self._last = self.wait(fault)
            return self._last
        if self._forecast is not None:
            self._forecast.move(observation.time)
        answer = self._native.update(observation)
        if answer is not None:
            computation_time = time.perf_counter() - started
            self._last = self._decisions(answer.decisions, answer.fault, computation_time)
        return self._last

    def wait(self, reason):
        """Slow down to rest, and stand still, because an input is missing or unusable.

        Args:
            reason: a clause that says what is wrong, without a full stop.

        Returns:
            A :class:`~.decision.Decision` with status WAITING for each assistant by its name. Each
            call is one command on the way to rest.
        """
        return self._decisions(self._native.wait(), reason)

    def margins(self, name, positions, distance):
        """The lowest h of each barrier in any state, not only the observed one.

        Args:
            name: of the assistant.
            positions: (A, 3) held points of all agents [m].
            distance: signed minimum distance of the object [m].

        Returns:
            A mapping from the barriers' names [m], without margins.
        """
        return self._by_barrier(self._native.margins(self._members[name], positions, distance))

    def _decisions(self, natives, fault="", computation_time=0.0):
        lacking = [name for name, native in zip(self._members, natives) if native.lacks_copies]
        if lacking:
            fault = f"the state has no ready perturbed copies of {', '.join(lacking)}"
        return {
            name: self._decision(native, fault, computation_time)
            for name, native in zip(self._members, natives)
        }

    def _decision(self, native, fault, computation_time):
        status = _STATUSES[native.status]
        slack = self._by_barrier(native.slack)
        position, target = native.position, native.target
        return Decision(
            status=status,
            text=_sentence(status, fault, slack),
            enabled=native.enabled,
            command=native.command,
            nominal=native.nominal,
            position=position,
            target=target,
            error=target - position,
            distance=native.distance,
            h=self._by_barrier(native.h),
            jacobian=native.jacobian,
            exact_jacobian=native.exact_jacobian,
            leader_drift=native.leader_drift,
            rows=native.rows,
            slack=slack,
            solve_time=native.solve_time,
            computation_time=computation_time,
        )

    def _by_barrier(self, values):
        return dict(zip(self._barriers, values))


def _sentence(status, fault, slack):
    """The status in words, with what it waits for and what is relaxed."""
    if status is Status.WAITING:
        return f"Waits, at rest or slowing down to it: {fault}."
    if status is Status.RELAXED:
        amounts = [f"{name} by {amount:.4f} m/s" for name, amount in slack.items() if amount]
        return f"{status.sentence[:-1]}: {', '.join(amounts)}."
    return status.sentence
