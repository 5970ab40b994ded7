"""The safe velocity controller of one or several assistants."""

import time

from deformable_manipulation import _control
from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.forecast import Forecast
from deformable_manipulation.control.observation import wrong_type
from deformable_manipulation.control.overload import find_overloads
from deformable_manipulation.control.parameters import native_parameters
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.control.status import DetourState, Status
from deformable_manipulation.scenario.controller import DECENTRALISED

_STATUSES = sorted(Status)
_DETOURS = sorted(DetourState)


def teams(scenario, names=None):
    """Names of the assistants that one controller commands, a tuple per controller.

    ``controller.cooperation`` says which: each assistant by itself, or all of a process by one.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        names: of the process's assistants; default: all of the scenario.
    """
    if names is None:
        names = [scenario.agents[index].name for index in scenario.assistants]
    if scenario.controller.cooperation == DECENTRALISED:
        return tuple((name,) for name in names)
    return (tuple(names),)


class TeamController:
    """Lets assistants follow the leader at fixed relative positions, as far as the barriers allow.

    One quadratic program over the velocities of all of them (docs/mathematics.md). With
    ``cooperation: coordinated`` it is over those of all assistants of the scenario, also of those
    that other controllers command. The command computed from state k acts from state k + 1 to
    k + 2, and everything is predicted for state k + 1. The mathematics is in the C++ core,
    ``_control.TeamController``.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        names: of the assistants that it commands.
        safety: False leaves the barriers out: the nominal velocities within their limits.
        trusting: True takes it that others go on as expected, however long nothing is heard of
            them: for lock-step, where every controller answers every state.

    Raises:
        ValueError: the scenario has no assistant of a name, or an unusable setting.
    """

    def __init__(self, scenario, names, safety=True, trusting=False):
        self._safety = safety
        self._barriers = scenario.controller.barriers
        self._needs_wrenches = safety and scenario.controller.needs_wrenches
        parameters = native_parameters(scenario, names, safety)
        agents = [scenario.agents[index].name for index in parameters.team["commanded"]]
        numbers = {name: number for number, name in enumerate(agents)}
        self._members = {name: numbers[name] for name in names}
        self._others = {name: numbers[name] for name in agents if name not in self._members}
        self._native = _control.TeamController(*parameters, find_solver(scenario.controller.solver))
        self._native.set_trusting(trusting)
        self._last = None
        self._refusal = None  # a clause that says why it does not begin; None: not known yet
        self._forecast = None
        if safety:
            self._forecast = Forecast(scenario)
            self._use(self._forecast, scenario.controller)

    def _use(self, forecast, settings):
        if settings.horizon.length > 0.0:
            self._native.look_ahead(
                forecast.make_shapes(),
                forecast.standing(),
                forecast.moving(),
                forecast.measured(),
                forecast.triangles,
            )
        if settings.detours and forecast.has_shapes and forecast.knows_all:
            for number in self._members.values():
                self._native.find_detours(number, forecast.make_shapes(), forecast.distance)

    @property
    def names(self):
        """Of the assistants that it commands, in order."""
        return tuple(self._members)

    @property
    def others(self):
        """Names of the assistants that it plans for, but which other controllers command."""
        return tuple(self._others)

    def intent(self, name):
        """How an assistant goes on from the last state, for those in whose ``others`` it is.

        Returns:
            ``_control.AssistantIntent``.
        """
        return self._native.intent(self._members[name])

    def hear(self, name, intent):
        """Take in what another controller tells about one of the ``others``.

        Args:
            name: of the assistant.
            intent: its ``_control.AssistantIntent``.
        """
        self._native.hear(self._others[name], intent)

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
        self._refusal = None

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
        fault = wrong_type(observation) or self._lacking(observation) or self._refusal
        if fault:
            self._last = self.wait(fault)
            return self._last
        if self._forecast is not None:
            self._forecast.move(observation.time)
            self._forecast.show(observation.seen)
        answer = self._native.update(observation)
        if answer is not None:
            computation_time = time.perf_counter() - started
            self._last = self._decisions(answer.decisions, answer.fault, computation_time)
            if self._refusal is None and not answer.fault:
                self._last = self._judged(self._last)
        return self._last

    def _judged(self, decisions):
        """The decisions on the first state, unless a limit of the object's loads is broken."""
        overloads = find_overloads({name: decision.h for name, decision in decisions.items()})
        self._refusal = "; ".join(map(str, overloads)) if self._safety else ""
        return self.wait(self._refusal) if self._refusal else decisions

    def _lacking(self, observation):
        """A clause if the observation does not tell what a barrier depends on."""
        if self._needs_wrenches and observation.wrenches is None:
            return "the state does not tell the wrenches at the grips, which barriers depend on"
        return ""

    def wait(self, reason):
        """Slow down to rest, and stand still, because an input is missing or unusable.

        Args:
            reason: a clause that says what is wrong, without a full stop.

        Returns:
            A :class:`~.decision.Decision` with status WAITING for each assistant by its name. Each
            call is one command on the way to rest.
        """
        return self._decisions(self._native.wait(), reason)

    def margins(self, name, observation):
        """The lowest h of each barrier in any state, not only the one that was answered.

        Args:
            name: of the assistant.
            observation: :class:`~.observation.Observation`.

        Returns:
            A mapping from the barriers' names, without margins, in the units of their kinds.

        Raises:
            ValueError: the observation is not valid; the message names the field.
        """
        return self._by_barrier(self._native.margins(self._members[name], observation))

    def _decisions(self, natives, fault="", computation_time=0.0):
        everybody = {**self._members, **self._others}
        lacking = [name for name, number in everybody.items() if natives[number].lacks_copies]
        if lacking:
            fault = f"the state has no ready perturbed copies of {', '.join(lacking)}"
        return {
            name: self._decision(natives[number], fault, computation_time)
            for name, number in self._members.items()
        }

    def _decision(self, native, fault, computation_time):
        status, detour = _STATUSES[native.status], _DETOURS[native.detour]
        slack = self._by_barrier(native.slack)
        position, target = native.position, native.target
        return Decision(
            status=status,
            text=" ".join(filter(None, (_sentence(status, fault, slack), detour.sentence))),
            enabled=native.enabled,
            coordinated=native.coordinated,
            detour=detour,
            command=native.command,
            nominal=native.nominal,
            angular_command=native.angular_command,
            angular_nominal=native.angular_nominal,
            orientation_error=native.orientation_error,
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
            reason=fault if status is Status.WAITING else "",
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
