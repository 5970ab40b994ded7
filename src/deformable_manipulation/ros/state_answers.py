"""How the nodes with controllers answer states."""

import dataclasses
import time

import rospy

from deformable_manipulation.control.team import teams
from deformable_manipulation.cycles.health import input_report
from deformable_manipulation.cycles.input_watch import find_age_fault
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import MessageError, to_observation
from deformable_manipulation.ros.diagnostics import cycle_monitor, publish_diagnostics
from deformable_manipulation.ros.overrun_report import OverrunReport, age_of
from deformable_manipulation.ros.team import Team


class StateAnswers:
    """Lets assistants answer states, and counts how well they keep up.

    Reads the node's parameter ``~lockstep``. Leaves the process with a message if the scenario has
    no assistants of these names.

    Args:
        scenario: the checked scenario.
        parameter: of the node, with the names of the assistants, separated by blanks.
    """

    def __init__(self, scenario, parameter):
        self._scenario = scenario
        self._lockstep = rospy.get_param("~lockstep", False)
        self._overruns = OverrunReport(scenario.cycle_time)
        agents = rospy.get_param(parameter, "").split() or [""]
        try:
            self._teams = [
                Team(scenario, names, self._overruns.counter) for names in teams(scenario, agents)
            ]
        except ValueError as error:
            node.refuse(f"Parameter {rospy.resolve_name(parameter)}: {error}")
        self._cycles = cycle_monitor(scenario)
        self._answered_at = 0.0  # [s] of time.perf_counter()

    def answer(self, state, distances_of, intent=None):
        """Command the velocities that answer a state, then report them.

        Args:
            state: the ObjectState.
            distances_of: function without arguments that gives the core's Distances of it, the
                poses (K, 7) of the moving obstacles, and what is seen of live ones, by their
                indices; may raise MessageError.
            intent: the leader's Intent, if it announces one.
        """
        started = self._answered_at = time.perf_counter()
        observation, fault = None, ""
        try:
            distances, obstacles, seen = distances_of()
            age = self._age(state)
            observation = dataclasses.replace(
                to_observation(state, distances, self._scenario, age, intent, obstacles), seen=seen
            )
        except MessageError as error:
            fault = f"cycle {state.cycle} cannot be used, {error}"
        decisions = self._decide(state, observation, fault)
        self._overruns.answered(state)
        self._send(state, observation, decisions)
        self._cycles.answered(time.perf_counter() - started, age_of(state))

    def _decide(self, state, observation, fault):
        return [team.decide(state, observation, fault) for team in self._teams]

    def _send(self, state, observation, decisions):
        # Commands are in a hurry, reports are not.
        for team, decided in zip(self._teams, decisions):
            team.send(state, decided)
        for team, decided in zip(self._teams, decisions):
            team.report(state, observation, decided)

    def watch(self, fault, newest_state):
        """From now on, slow assistants down while inputs are lost, and say how all fare.

        They get a command per cycle then, as their limits of acceleration count from one to the
        next.

        Args:
            fault: function without arguments: a clause that says what is lost, or nothing.
            newest_state: function without arguments: the newest state, or None.
        """

        def check():
            lost, state = fault(), newest_state()
            unanswered = time.perf_counter() - self._answered_at >= self._scenario.cycle_time
            if lost and state is not None and unanswered:
                self._send(state, None, self._decide(state, None, lost))

        reports = {"cycle": self._cycles.report, "inputs": lambda: input_report(fault())}
        for team in self._teams:
            reports.update(team.reports)
        publish_diagnostics(reports)
        if not self._lockstep:  # there everybody waits for everybody
            node.every(self._scenario.cycle_time, check)

    def _age(self, state):
        """Age [s] of a state that is about to be answered. Raises MessageError: it is too old."""
        if self._lockstep:  # the state waits for the answer, however long that takes
            return 0.0
        age = age_of(state)
        fault = find_age_fault(age, self._scenario.controller.timeout)
        if fault:
            raise MessageError(fault)
        return age
