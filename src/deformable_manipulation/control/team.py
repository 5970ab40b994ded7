"""The safe velocity controller of one or several assistants: of all of them it is centralised."""

import time

from deformable_manipulation import _control
from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.observation import wrong_type
from deformable_manipulation.control.parameters import native_parameters
from deformable_manipulation.control.status import Status
from deformable_manipulation.scenario.spec import CENTRALISED

_STATUSES = sorted(Status)
_KINDS = ("collision", "overstretch", "proximity")


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
        self._native = _control.TeamController(native_parameters(scenario, names, safety))
        self._last = None

    @property
    def names(self):
        """Of the assistants that it commands, in order."""
        return tuple(self._members)

    def is_enabled(self, name):
        """Whether an assistant follows; if not, it gets zero velocity, and the others know."""
        return self._native.is_enabled(self._members[name])

    def set_enabled(self, name, enabled):
        """Let an assistant follow, or stand still."""
        self._native.set_enabled(self._members[name], enabled)

    def set_parameters(self, scenario):
        """Go on with the gains, limits and margins of another scenario of the same agents.

        What was observed and the references stay, and so do ``formulation``, ``priority`` and
        ``solver``.

        Raises:
            ValueError: they cannot be used; nothing changes then.
        """
        self._native.set_parameters(native_parameters(scenario, self.names, self._safety))

    def reset(self):
        """Back to the start: forget all states and take the scenario's references again."""
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

        A state that is not newer than the last one gets the same answer again; one that is older
        by more than the timeout means that time was set back, and starts afresh.

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
        outcome = self._native.update(observation)
        if outcome is not None:
            fault, decisions = outcome
            self._last = self._decisions(decisions, fault, time.perf_counter() - started)
        return self._last

    def wait(self, reason):
        """Stand still because an input is missing or unusable.

        Args:
            reason: a clause that says what is wrong, without a full stop.

        Returns:
            A :class:`~.decision.Decision` with zero velocity and status WAITING for each assistant
            by its name.
        """
        return self._decisions(self._native.wait(), reason)

    def _decisions(self, outcomes, fault="", computation_time=0.0):
        lacking = [name for name, outcome in zip(self._members, outcomes) if outcome[0]]
        if lacking:
            fault = f"the state has no ready perturbed copies of {', '.join(lacking)}"
        return {
            name: self._decision(name, outcome[1:], fault, computation_time)
            for name, outcome in zip(self._members, outcomes)
        }

    def _decision(self, name, outcome, fault, computation_time):
        number, fields, slacks, solve_time = outcome
        status = _STATUSES[number]
        if status is Status.WAITING:
            text = f"Waits, zero velocity: {fault}."
        elif status is Status.RELAXED:
            text = _relaxation(slacks)
        else:
            text = status.sentence
        return Decision(  # type: ignore[call-arg]
            status, text, self.is_enabled(name), *fields, *slacks, solve_time, computation_time
        )


def _relaxation(slacks):
    amounts = [f"{kind} by {slack:.4f} m/s" for kind, slack in zip(_KINDS, slacks) if slack]
    return f"{Status.RELAXED.sentence[:-1]}: {', '.join(amounts)}."
