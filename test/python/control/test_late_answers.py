"""Answers that come later than a cycle after their state are predicted further."""

import dataclasses

import control_builders as build
import numpy as np
import pytest
from control_run import Run

from deformable_manipulation.control.team import TeamController, teams
from deformable_manipulation.scenario.spec import CENTRALISED, DECENTRALISED, CollisionSpec

VELOCITIES = np.array([[0.03, -0.02, -0.1], [0.0, 0.0, 0.0], [0.02, 0.05, -0.04]])  # m/s
TIP = build.LinearObject(  # a point that all three move
    np.array([0.3, 0.5, 0.2])[:, None, None, None] * np.eye(3), np.array([[0.0, 0.0, -0.6]])
)


def commands(scenario, lateness, ahead):
    """Answers to a state that is moved ``ahead`` [s]; the assistants know of no commands before."""
    velocities = np.where([[True], [False], [False]], VELOCITIES, 0.0)
    positions = np.array([agent.start for agent in scenario.agents]) + ahead * velocities
    ground = build.HalfSpace((0.0, 0.6, 0.8), 0.73, (0.0, 0.0, 0.05)).at(ahead)
    observation = dataclasses.replace(
        build.observe(0.0, positions, TIP, ground), velocities=velocities, lateness=lateness
    )
    decided = {}
    for names in teams(scenario):
        decided.update(TeamController(scenario, names).update(observation))
    return np.array([[each.nominal, each.command] for each in decided.values()])


@pytest.mark.parametrize("cooperation", [DECENTRALISED, CENTRALISED])
def test_a_late_answer_is_that_to_the_state_at_which_it_acts(cooperation):
    scenario = build.scenario(2, cooperation=cooperation, max_acceleration=100.0)
    late = commands(scenario, lateness=0.05, ahead=0.0)
    np.testing.assert_allclose(late, commands(scenario, lateness=0.0, ahead=0.05), atol=1e-9)
    assert np.abs(late - commands(scenario, lateness=0.0, ahead=0.0)).max(axis=(0, 2)).min() > 1e-3


def test_the_offset_holds_though_all_answers_are_late():
    """A leader that dives towards the ground, with answers that act five cycles late."""
    waypoints = ((0.0, (0.0, 0.0, 0.0)), (1.0, (0.0, 0.0, 0.0)), (5.0, (0.0, 0.0, -0.5)))
    steep = (5.0, 5.0)  # without the reserves that would hide it
    collision = CollisionSpec(offset=0.05, margin=0.0, alpha=steep, anticipation=steep)
    scenario = build.scenario(1, waypoints, collision=collision, max_velocity=0.5)
    lowest = {
        told: Run(scenario, 6.0, late=5, told=told).h("collision").min() for told in (True, False)
    }
    assert lowest[False] < -5e-3 < -1e-6 < lowest[True]
