"""The pole over the cupboard: limits of its loads are near, which fixed grips break."""

import numpy as np
import pytest

from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

OVER_THE_EDGE = ("simulation.duration", "20.0")  # s, until the pole's end has passed it


def run(*overrides):
    loop = ClosedLoop(load_scenario("tent_pole_one_assistant", [OVER_THE_EDGE, *overrides]))
    return [loop.step().decisions["assistant_1"] for _ in range(2000)]


@pytest.fixture(scope="module")
def turning():
    return run()


def lowest(decisions, name):
    return min(decision.h[name] for decision in decisions)


def test_a_grip_that_turns_keeps_limits_that_are_active(turning):
    for name, limit in (("bending", 1.0 / 0.66), ("grip_torque", 3.0)):
        reserve = 0.02 * limit
        assert 0.0 <= lowest(turning, name) < 2.0 * reserve, name
    assert lowest(turning, "collision") >= 0.0
    assert max(np.abs(decision.angular_command).max() for decision in turning) > 0.1
    assert max(np.linalg.norm(decision.orientation_error) for decision in turning) > 0.1


def test_a_grip_that_does_not_turn_breaks_them():
    fixed = run(("controller.orientation", "fixed"))
    assert lowest(fixed, "bending") < -0.3  # 1/m
    assert lowest(fixed, "grip_torque") < -1.0  # N m
    assert not any(decision.angular_command.any() for decision in fixed)


def test_without_the_limits_of_loads_a_turning_pole_exceeds_them():
    wide = run(
        ("controller.bending.min_radius", "0.1"), ("controller.grip_torque.max_torque", "50.0")
    )
    bent = 10.0 - lowest(wide, "bending")  # 1/m
    assert bent > 1.05 / 0.66 or 50.0 - lowest(wide, "grip_torque") > 1.05 * 3.0
