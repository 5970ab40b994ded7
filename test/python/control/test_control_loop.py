"""Closed loop on objects that follow their held points at once, one cycle of delay, 100 Hz."""

import functools

import control_builders as build
import numpy as np
import pytest
from control_run import Run
from scipy.signal import butter, filtfilt

from deformable_manipulation.control.status import DetourState, Status
from deformable_manipulation.scenario.spec import (
    CENTRALISED,
    DECENTRALISED,
    OverstretchSpec,
)

FAR = build.HalfSpace((0.0, 0.0, 1.0), -9.0)
# The leader sinks at up to 0.15 m/s, until the object would be 0.15 m in the ground, and moves on.
DIVE = ((0.0, (0, 0, 0)), (0.5, (0, 0, 0)), (6.5, (0, 0.2, -0.5)), (9.0, (0, 0.4, -0.5)))


@functools.lru_cache(maxsize=None)
def dive(assistants, safety=True, duration=11.0, **settings):
    return Run(build.scenario(assistants, DIVE, **settings), duration, safety=safety)


@pytest.mark.parametrize("cooperation", [DECENTRALISED, CENTRALISED])
@pytest.mark.parametrize("assistants", [1, 2, 3])
def test_keeps_off_the_ground_while_the_leader_dives(assistants, cooperation):
    run = dive(assistants, cooperation=cooperation)
    assert run.h("collision").min() >= -1e-3
    assert run.h("overstretch").min() >= -1e-3
    assert run.h("proximity").min() >= -1e-3
    assert set(run.all("status").flat) <= {Status.NOMINAL, Status.CONSTRAINED}
    # It comes near, and the leader alone stays clear of the ground.
    assert run.h("collision").min() < 0.02
    assert run.positions[:, 0, 2].min() > 0.3


def test_an_object_with_other_points_than_the_scenarios_gets_no_detour():
    """The shapes of a detour have the scenario's points: others must not be written over."""
    run = dive(1)
    assert (
        np.linalg.norm(run.all("error"), axis=-1)[-100:] > 0.05
    ).all()  # it is held off its place
    assert set(run.all("detour").flat) == {DetourState.NONE}


def test_the_object_hits_the_ground_without_the_filter():
    assert dive(1, safety=False, duration=7.0).all("distance").min() < -0.04


def test_leaving_the_leaders_velocity_out_breaks_the_offset():
    lowest = dive(1).h("collision").min()
    assert dive(1, feedforward=False, duration=7.0).h("collision").min() < lowest - 2e-3


def test_the_papers_formulation_falls_short_on_the_same_dive():
    papers = build.scenario(1, DIVE, formulation="paper", feedforward=False)
    lowest = Run(papers, 7.0).h("collision").min()
    assert lowest < -1e-3 < 0.0 <= dive(1).h("collision").min()


@pytest.mark.parametrize("cooperation", [DECENTRALISED, CENTRALISED])
@pytest.mark.parametrize("assistants", [1, 3])
def test_commands_do_not_oscillate(assistants, cooperation):
    run = dive(assistants, cooperation=cooperation)
    high_pass = butter(4, 1.0, "highpass", fs=100.0)  # Hz
    for signal in (run.all("distance"), run.h("overstretch"), run.h("proximity")):
        fast = filtfilt(*high_pass, signal, axis=0)
        assert np.sqrt(np.mean(fast**2)) < 2e-4
    steps = np.diff(run.all("command"), axis=0)
    assert np.abs(steps).max() <= 0.01 + 1e-9  # 1 m/s^2
    flips = (steps[1:] * steps[:-1] < 0.0) & (np.abs(steps[1:]) > 1e-3)
    assert flips.mean() < 0.01


@pytest.mark.parametrize("assistants", [1, 2])
def test_follows_without_error_far_from_obstacles(assistants):
    across = ((0.0, (0, 0, 0)), (0.5, (0, 0, 0)), (4.5, (0.2, 0, 0.1)), (7.0, (0.1, 0.1, 0.1)))
    errors = Run(build.scenario(assistants, across), 9.0, FAR).all("error_norm")
    assert errors.max() < 5e-3
    assert errors[-1].max() < 1e-3


def test_gives_way_to_a_moving_obstacle():
    rising = build.HalfSpace((0.0, 0.0, 1.0), 0.2, (0.0, 0.0, 0.03))
    run = Run(build.scenario(1), 8.0, rising)
    assert run.h("collision").min() >= -1e-3
    assert run.positions[-1, 1, 2] > run.positions[0, 1, 2] + 0.05


def test_a_formation_at_its_stretch_limit_moves_on():
    apart = ((0.0, (0, 0, 0)), (0.5, (0, 0, 0)), (4.5, (0, -0.25, 0)))
    scenario = build.scenario(2, apart, overstretch=OverstretchSpec(1.501, margin=0.0))
    run = Run(scenario, 7.0, FAR)
    assert run.h("overstretch").min() >= -1e-3
    assert run.all("error_norm").max() < 5e-3
