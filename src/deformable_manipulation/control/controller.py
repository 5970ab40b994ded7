"""The safe velocity controller of one assistant."""

import time

from deformable_manipulation import _control
from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.observation import wrong_type
from deformable_manipulation.control.parameters import native_parameters
from deformable_manipulation.control.status import Status

_STATUSES = sorted(Status)
_KINDS = ("collision", "overstretch", "proximity")


class AssistantController:
    """Follows the leader at a fixed relative position, as far as the barriers allow.

    The command computed from state k acts from state k + 1 to k + 2, and everything is predicted
    for state k + 1 (docs/mathematics.md). Decentralised: it uses its own observations alone. The
    mathematics is in the C++ core, ``_control.AssistantController``.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        agent: name of the assistant.
        safety: False leaves the barriers out: the nominal velocity within its limits.

    Raises:
        ValueError: the scenario has no assistant of that name, or an unusable setting.
    """

    def __init__(self, scenario, agent, safety=True):
        self._name = agent
        self._safety = safety
        self._native = _control.AssistantController(native_parameters(scenario, agent, safety))
        self._last = None

    @property
    def enabled(self):
        """False answers every state with zero velocity."""
        return self._native.enabled

    @enabled.setter
    def enabled(self, enabled):
        self._native.enabled = enabled

    def reset(self):
        """Back to the start: forget all states and take the scenario's reference again."""
        self._native.reset()

    def set_parameters(self, scenario):
        """Go on with the gains, limits and margins of another scenario of the same agents.

        What was observed and the reference stay, and so do ``formulation``, ``priority`` and
        ``solver``.

        Raises:
            ValueError: they cannot be used; nothing changes then.
        """
        self._native.set_parameters(native_parameters(scenario, self._name, self._safety))

    def take_reference(self, observation):
        """Follow the leader at the present relative position from now on.

        Raises:
            ValueError: the observation is not valid; the message names the field.
        """
        fault = wrong_type(observation)
        if fault:
            raise ValueError(fault)
        self._native.take_reference(observation)

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
        fault = wrong_type(observation)
        if fault:
            self._last = self.wait(fault)
            return self._last
        outcome = self._native.update(observation)
        if outcome is not None:
            fault, lacks_copies, values = outcome
            if lacks_copies:
                fault = f"the state has no ready perturbed copies of {self._name}"
            self._last = self._decision(values, fault, time.perf_counter() - started)
        return self._last

    def wait(self, reason):
        """Stand still because an input is missing or unusable.

        Args:
            reason: a clause that says what is wrong, without a full stop.

        Returns:
            :class:`~.decision.Decision` with zero velocity and status WAITING.
        """
        return self._decision(self._native.wait(), reason)

    def _decision(self, outcome, fault="", computation_time=0.0):
        number, fields, slacks, solve_time = outcome
        status = _STATUSES[number]
        if status is Status.WAITING:
            text = f"Waits, zero velocity: {fault}."
        elif status is Status.RELAXED:
            text = _relaxation(slacks)
        else:
            text = status.sentence
        return Decision(
            status, text, self._native.enabled, *fields, *slacks, solve_time, computation_time
        )


def _relaxation(slacks):
    amounts = [f"{kind} by {slack:.4f} m/s" for kind, slack in zip(_KINDS, slacks) if slack]
    return f"{Status.RELAXED.sentence[:-1]}: {', '.join(amounts)}."
