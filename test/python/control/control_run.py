"""Closed loop on objects that follow their held points at once, one cycle of delay or more."""

import dataclasses
from collections import deque

import control_builders as build
import numpy as np

from deformable_manipulation.control.team import TeamController, teams
from deformable_manipulation.motion.leader import LeaderController

GROUND = build.HalfSpace((0.0, 0.0, 1.0), 0.0)


class Run:
    """Histories of a run: time first.

    ``body``: a :class:`~control_builders.LinearObject`; default: a chain that hangs through by
    ``sag`` [m]. The assistants' answers come ``late`` by so many cycles; they are ``told`` so, or
    not. With ``heard``, each assistant has a controller of its own, and another one's intent about
    cycle k arrives if ``heard(name, k)``.
    """

    def __init__(
        self,
        scenario,
        duration,
        obstacle=GROUND,
        sag=0.55,
        body=None,
        late=0,
        told=True,
        heard=None,
        **settings,
    ):
        parts = teams(scenario)
        if heard is not None:
            parts = [(scenario.agents[index].name,) for index in scenario.assistants]
        controllers = [TeamController(scenario, names, **settings) for names in parts]
        leader = LeaderController(scenario)
        body = body or build.hanging_chain(len(scenario.agents), sag)
        positions = np.array([agent.start for agent in scenario.agents])
        leading, following = np.zeros(3), deque([np.zeros_like(positions[1:])] * (late + 1))
        states, decisions = [], []
        for k in range(round(duration / scenario.cycle_time)):
            time = k * scenario.cycle_time
            observation = dataclasses.replace(
                build.observe(time, positions, body, obstacle.at(time), cycle=k),
                lateness=late * scenario.cycle_time if told else 0.0,
            )
            decided = [each for team in controllers for each in team.update(observation).values()]
            if heard is not None:
                _exchange(controllers, lambda name, k=k: heard(name, k))
            states.append(positions)
            decisions.append(decided)
            following.append(np.array([each.command for each in decided]))
            acting, leading = leading, leader.update(time, positions[0])
            positions = positions + scenario.cycle_time * np.vstack((acting, following.popleft()))
        self.positions = np.array(states)
        self.decisions = decisions

    def all(self, field):
        return np.array([[getattr(each, field) for each in row] for row in self.decisions])

    def h(self, barrier):
        return np.array([[each.h[barrier] for each in row] for row in self.decisions])


def _exchange(controllers, heard):
    """Each hears the intents of the others' assistants that arrive."""
    for teller in controllers:
        for name in filter(heard, teller.names):
            for other in controllers:
                if name in other.others:
                    other.hear(name, teller.intent(name))
