"""Commands where the active limits change."""

import control_builders as build
import numpy as np
import pytest

from deformable_manipulation.control.status import Status

TILT = np.radians(5.0)
T = 0.2  # s


def ground(tilt):
    """Touched by the chain's middle at a distance of 60 mm, as the assistant is held 0.4 m high."""
    normal = np.array([0.0, np.sin(tilt), np.cos(tilt)])
    return build.HalfSpace(normal, normal @ (0.0, 0.75, 0.9) - 0.06)


def answers(smoothing, tilts):
    """Decisions of an assistant held off its place, on ground of each tilt; None: no ground."""
    scenario = build.scenario(smoothing=smoothing, max_acceleration=100.0, max_velocity=1.0)
    positions = np.array([agent.start for agent in scenario.agents]) + [[0, 0, 0], [0, 0, 0.4]]
    controller = build.Alone(scenario)
    chain = build.hanging_chain(2, sag=0.3, points=3)
    return [
        controller.update(build.observe(0.01 * k, positions, chain, obstacle))
        for k, obstacle in enumerate(None if tilt is None else ground(tilt) for tilt in tilts)
    ]


@pytest.fixture(scope="module")
def tilted():
    return [0.0] * 300 + [TILT] * 300


@pytest.fixture(scope="module")
def smooth(tilted):
    return answers(T, tilted)


def test_other_rows_make_no_step(smooth, tilted):
    def step(decisions):
        return np.abs(decisions[300].command - decisions[299].command).max()

    assert step(answers(0.0, tilted)) > 0.02
    assert step(smooth) < 0.003


def test_the_limits_hold_in_every_cycle(smooth):
    for decision in smooth:
        assert decision.status == Status.CONSTRAINED
        assert decision.jacobian @ decision.command >= -(decision.distance - 0.052) - 1e-3


def test_the_steady_answers_are_those_without(smooth, tilted):
    sharp = answers(0.0, tilted)
    for k in (299, 599):
        np.testing.assert_allclose(smooth[k].command, sharp[k].command, atol=1e-5)


def test_a_reference_taken_is_kept_at_once():
    """Nothing is left of the departure from the former one."""
    scenario = build.scenario(smoothing=T)
    positions = np.array([agent.start for agent in scenario.agents]) + [[0, 0, 0], [0, 0, 0.4]]
    controller = build.Alone(scenario)
    chain = build.hanging_chain(2, sag=0.3, points=3)
    for k in range(301):
        observation = build.observe(0.01 * k, positions, chain, ground(0.0))
        if k == 300:
            controller.take_reference(observation)
        decision = controller.update(observation)
    assert np.abs(decision.nominal).max() < 0.01
    np.testing.assert_allclose(decision.command, 0.0, atol=0.011)


def test_bounds_alone_leave_no_departure():
    """Far from obstacles a leader that starts at once is followed at the full acceleration."""
    scenario = build.scenario(smoothing=T)
    controller = build.Alone(scenario)
    chain, start = build.hanging_chain(2, sag=0.3), [agent.start for agent in scenario.agents]
    for k in range(13):
        moved = np.array(start) + [[0.0, 0.001 * k, 0.0], [0.0, 0.0, 0.0]]
        decision = controller.update(build.observe(0.01 * k, moved, chain, None))
    np.testing.assert_allclose(decision.command, decision.nominal, atol=1e-12)


def test_the_way_back_begins_smoothly_and_is_the_nominal_one():
    released = answers(T, [0.0] * 300 + [None] * 400)
    departures = [np.linalg.norm(each.command - each.nominal) for each in released[299:]]
    assert departures[1] > 0.9 * departures[0] > 0.1
    np.testing.assert_allclose(departures[41] / departures[21], np.exp(-1.0), rtol=0.01)
    assert released[-1].status == Status.NOMINAL
