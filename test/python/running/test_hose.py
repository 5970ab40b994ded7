"""The hose over the wall: a limit of its tension and the wall meet while it is lifted over."""

import numpy as np
import pytest

from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

MAX_TENSION, MAX_FORCE = 4.0, 6.0  # N
LIFTED = 58.0  # s, until its first half is taut over the edge of the wall
ASSISTANTS = ("assistant_1", "assistant_2")


def run(*overrides):
    """Decisions of both assistants, cycle by cycle."""
    scenario = load_scenario(
        "hose_two_assistants", [("simulation.duration", str(LIFTED)), *overrides]
    )
    loop = ClosedLoop(scenario)
    decisions = [loop.step().decisions for _ in range(scenario.cycles)]
    return [decision[name] for decision in decisions for name in ASSISTANTS]


def least(decisions, name):
    return min(decision.h[name] for decision in decisions)


@pytest.fixture(scope="module")
def limited():
    return run()


def test_both_limits_of_force_and_the_wall_are_active_and_kept(limited):
    for name, limit in (("tension", MAX_TENSION), ("grip_force", MAX_FORCE)):
        assert 0.0 <= least(limited, name) < 0.08 * limit, name
    assert 0.0 <= least(limited, "collision") < 0.005
    near = [d for d in limited if d.h["tension"] < 0.03 * MAX_TENSION]
    assert min(decision.h["collision"] for decision in near) < 0.005  # both at a time
    assert not any(np.abs(list(decision.slack.values())).max() > 1e-6 for decision in limited)


def test_without_the_limits_the_hose_is_pulled_taut():
    wide = run(("controller.tension.max_tension", "50"), ("controller.grip_force.max_force", "50"))
    assert 50.0 - least(wide, "tension") > 1.5 * MAX_TENSION
    assert 50.0 - least(wide, "grip_force") > 1.2 * MAX_FORCE
    assert least(wide, "collision") >= 0.0
