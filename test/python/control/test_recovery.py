"""Starts beyond a limit, and limits that contradict each other, in closed loop."""

import itertools

import control_builders as build
import numpy as np
import pytest
from control_run import Run

from deformable_manipulation.control.status import Status
from deformable_manipulation.scenario.spec import (
    CENTRALISED,
    DECENTRALISED,
    CollisionSpec,
    OverstretchSpec,
    ProximitySpec,
)

SAG = 0.55
LOWEST = 1.0 - SAG  # m, the chain's lowest point at the start
OFFSET = 0.05  # m
KINDS = ("collision", "overstretch", "proximity")
U_MAX, ACCELERATION, CYCLE = 0.15, 1.0, 0.01
WITHIN = {"overstretch": OverstretchSpec(2.0), "proximity": ProximitySpec(0.2)}

# What is missed at the start by how much [m]; the ends of the chain are 1.5 m apart.
STARTS = {
    "3 cm within the offset": dict(depth=0.03),
    "in the ground": dict(depth=OFFSET + 0.04),
    "overstretched": dict(overstretch=OverstretchSpec(1.45)),
    "too near": dict(proximity=ProximitySpec(1.53)),
    "in the ground and overstretched": dict(depth=OFFSET + 0.04, overstretch=OverstretchSpec(1.45)),
    "in the ground and too near": dict(depth=OFFSET + 0.04, proximity=ProximitySpec(1.53)),
}


def start(assistants=1, depth=-1.0, duration=6.0, **settings):
    """A run of a leader at rest from a chain ``depth`` within the offset."""
    ground = build.HalfSpace((0.0, 0.0, 1.0), LOWEST - OFFSET + depth)
    scenario = build.scenario(assistants, **{**WITHIN, **settings})
    return Run(scenario, duration, ground, SAG)


def shortfall(run, kind):
    """By how much a limit is missed at each time [m]."""
    return np.maximum(0.0, -run.h(kind).min(axis=1))


def reach(k):
    """Velocity [m/s] that an assistant can have from state k on."""
    return min(U_MAX, ACCELERATION * CYCLE * (k - 1))


@pytest.mark.parametrize("where", STARTS)
def test_one_assistant_comes_back_as_fast_as_it_can_and_stays(where):
    run = start(1, **STARTS[where])
    slopes = {"collision": (5.0, 0.5), "overstretch": (2.0, 1.0), "proximity": (2.0, 1.0)}
    for kind, (alpha, gradient) in slopes.items():
        missing = shortfall(run, kind)
        assert (np.diff(missing) <= 1e-9).all()
        for k in range(2, len(missing) - 1):
            fastest = min(alpha * missing[k], gradient * reach(k))
            assert (missing[k] - missing[k + 1]) / CYCLE >= 0.9 * fastest - 1e-4
        assert missing[-1] < 1e-6  # without a margin the limit is approached, no more
    assert max(shortfall(run, kind)[0] for kind in slopes) >= 0.03 - 1e-9


@pytest.mark.parametrize("where", STARTS)
@pytest.mark.parametrize("cooperation", [DECENTRALISED, CENTRALISED])
def test_two_assistants_come_back_and_stay(cooperation, where):
    settings = dict(STARTS[where])
    if "proximity" in settings:  # the first one is in the middle, too near to both others
        settings["proximity"] = ProximitySpec(0.78)
    run = start(2, cooperation=cooperation, **settings)
    for kind in KINDS:
        missing = shortfall(run, kind)
        assert (np.diff(missing) <= 1e-9).all(), kind
        assert missing[-1] <= 0.3 * missing[0], kind


def test_centralised_frees_the_one_in_the_middle_at_once():
    """Decentralised it has to wait until the outer one, with half the demand, has made way."""
    settings = dict(assistants=2, proximity=ProximitySpec(0.78), duration=3.0)
    left = {
        mode: shortfall(start(cooperation=mode, **settings), "proximity")[-1]
        for mode in (DECENTRALISED, CENTRALISED)
    }
    assert left[CENTRALISED] < 0.001 < 0.005 < left[DECENTRALISED] < 0.01


@pytest.mark.parametrize(
    "cooperation, most, left",
    [
        (
            DECENTRALISED,
            0.034,
            0.007,
        ),  # those in the middle are pushed on before the last one is away
        (CENTRALISED, 0.03, 1e-5),
    ],
)
def test_a_row_of_three_that_are_all_too_near_to_one_another_opens(cooperation, most, left):
    """The rows of those in the middle contradict, all out of reach in a cycle: none may freeze."""
    run = start(3, cooperation=cooperation, proximity=ProximitySpec(0.53), duration=10.0)
    missing = shortfall(run, "proximity")
    assert missing[0] == pytest.approx(0.03)
    assert missing.max() < most + 1e-9 and missing[-1] < left


def pushed(priority):
    """An assistant pushed away from its leader, farther than it may go, by a wall that advances."""
    identity = np.zeros((2, 1, 3, 3))
    identity[1, 0] = np.eye(3)
    tip = build.LinearObject(identity, np.zeros((1, 3)))
    wall = build.HalfSpace((0.0, 1.0, 0.0), 1.35, (0.0, 0.03, 0.0))
    scenario = build.scenario(1, priority=priority, overstretch=OverstretchSpec(1.55))
    return Run(scenario, 7.0, wall, body=tip)


@pytest.mark.parametrize("priority", list(itertools.permutations(KINDS)))
def test_limits_that_contradict_yield_in_the_order_of_the_priority(priority):
    run = pushed(priority)
    first, second = sorted(("collision", "overstretch"), key=priority.index)
    assert run.h(first).min() > -1e-3
    assert run.h(second).min() < -0.02
    last = run.decisions[-1][0]
    assert last.status == Status.RELAXED
    assert last.slack[first] == 0.0 < last.slack[second]
    # It neither stops nor chatters: with the wall, or where the object's reach ends.
    velocity = run.all("command")[-100:, 0, 1]
    np.testing.assert_allclose(velocity, 0.03 if first == "collision" else 0.0, atol=2e-3)


def test_a_start_that_contradicts_is_mended_by_priority():
    """In a wall behind it and too near to its leader in front of it."""
    wall = build.HalfSpace((0.0, -1.0, 0.0), -1.52)  # beyond y = 1.52
    for first, second in (("collision", "proximity"), ("proximity", "collision")):
        scenario = build.scenario(
            1,
            priority=(first, second, "overstretch"),
            proximity=ProximitySpec(1.53),
            collision=CollisionSpec(offset=OFFSET),
        )
        run = Run(scenario, 4.0, wall, SAG)
        assert (np.diff(shortfall(run, first)) <= 1e-9).all()
        assert shortfall(run, first)[0] > 0.02 and shortfall(run, first)[-1] < 1e-4
        assert run.decisions[-1][0].status == Status.RELAXED
