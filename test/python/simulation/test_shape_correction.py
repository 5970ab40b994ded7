"""Measured points correct where a simulated rod is."""

from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation._pbd import ParameterError
from deformable_manipulation.reading.plain import plain
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.scenario.spec import CorrectionSpec
from deformable_manipulation.simulation.factory import make_simulation

SHORT_ROPE = Path(__file__).resolve().parents[2] / "rostest" / "short_rope.yaml"
SCENARIO = load_scenario(SHORT_ROPE)
LENGTH, CYCLE = SCENARIO.object.length, SCENARIO.cycle_time


def corrected(**parameters):
    simulation = make_simulation(SCENARIO)
    simulation.correct(plain(CorrectionSpec(**parameters)))
    return simulation


class Object:
    """The object that is seen: the model at rest, sagging more by a smooth amount [m]."""

    def __init__(self, simulation, sag=0.03):
        self.model = simulation.points()[0].copy()
        self.arcs = np.linspace(0.0, LENGTH, len(self.model))
        self.difference = np.zeros_like(self.model)
        held = LENGTH / (len(self.model) - 1) * 0.5
        inside = np.clip((self.arcs - held) / (LENGTH - 2.0 * held), 0.0, 1.0)
        self.difference[:, 2] = -sag * np.sin(np.pi * inside) ** 2
        self.points = self.model + self.difference

    def seen(self, places):
        return np.stack([np.interp(places, self.arcs, axis) for axis in self.points.T], axis=1)


def show(simulation, seen, seconds, places=True, noise=0.0, count=20, random=None):
    """Let it run while pictures come at 20 Hz; returns its points after each cycle."""
    points = []
    arcs = np.linspace(0.0, LENGTH, count)
    for cycle in range(round(seconds / CYCLE)):
        simulation.advance()
        points.append(simulation.points()[0].copy())
        if cycle % 5 == 0:
            picture = seen.seen(arcs)
            if noise:
                picture += noise * random.standard_normal(picture.shape)
            refusal = simulation.measure(simulation.time, picture, arcs if places else None)
            assert refusal == ""
    return np.array(points)


def error(simulation, seen):
    return np.linalg.norm(simulation.points()[0] - seen.points, axis=1).max()


def test_the_shape_goes_to_what_is_measured():
    simulation = corrected()
    seen = Object(simulation)
    assert error(simulation, seen) == pytest.approx(0.03, rel=0.05)
    show(simulation, seen, 4.0)
    assert error(simulation, seen) < 0.002


def test_places_need_not_be_known():
    simulation = corrected()
    seen = Object(simulation)
    show(simulation, seen, 4.0, places=False, count=100)
    fine = seen.seen(np.linspace(0.0, LENGTH, 1000))
    apart = np.linalg.norm(simulation.points()[0][:, None] - fine, axis=2)
    assert apart.min(axis=1).max() < 0.004


def test_all_copies_are_moved_alike_and_held_points_stay():
    simulation = corrected()
    before = simulation.points() - simulation.points()[:1]
    held = simulation.positions()
    show(simulation, Object(simulation), 4.0)
    after = simulation.points()
    np.testing.assert_allclose(after - after[:1], before, atol=2e-3)
    centres = 0.5 * (after[0, :-1] + after[0, 1:])
    for agent, place in zip(SCENARIO.agents, held):
        assert np.linalg.norm(centres[agent.particle] - place) < 0.004
    np.testing.assert_allclose(
        simulation.points()[0] - simulation.correction, simulation.body.points()[0], atol=1e-12
    )


def test_it_never_jumps_and_noise_moves_it_slowly():
    simulation = corrected()
    random = np.random.default_rng(1)
    seen = Object(simulation, sag=0.0)
    moved = show(simulation, seen, 10.0, noise=0.005, random=random)
    speeds = np.linalg.norm(np.diff(moved, axis=0), axis=2) / CYCLE
    assert speeds.max() < 0.025
    assert np.sqrt((speeds[200:] ** 2).mean()) < 0.006
    assert error(simulation, seen) < 0.005


def test_it_fades_when_measurements_stop():
    simulation = corrected(fading_time=2.0)
    seen = Object(simulation)
    show(simulation, seen, 4.0)
    there = np.abs(simulation.correction).max()
    fading = []
    for _ in range(round(6.0 / CYCLE)):
        simulation.advance()
        fading.append(np.abs(simulation.correction).max())
    assert (np.diff(fading[100:]) < 0.0).all()
    assert fading[-1] < 0.08 * there
    assert fading[round(0.2 / CYCLE)] > 0.85 * there


def test_what_is_not_seen_is_told_by_the_rest():
    simulation = corrected()
    seen = Object(simulation)
    half = np.linspace(0.0, 0.55 * LENGTH, 12)
    for cycle in range(round(5.0 / CYCLE)):
        simulation.advance()
        if cycle % 5 == 0:
            simulation.measure(simulation.time, seen.seen(half), half)
    assert error(simulation, seen) < 0.02


def test_late_pictures_belong_to_the_shape_of_then():
    simulation = corrected()
    seen = Object(simulation, sag=0.0)
    velocity = np.array([0.0, 0.1, 0.0])
    for agent in range(len(SCENARIO.agents)):
        simulation.set_command(agent, velocity)
    start = simulation.points()[0].copy()
    own = []
    for cycle in range(200):
        simulation.advance()
        own.append((simulation.time, simulation.body.points()[0].copy()))
        if cycle >= 30 and cycle % 5 == 0:
            time, points = own[-30]
            assert simulation.measure(time, points, seen.arcs) == ""
    assert np.abs(simulation.points()[0] - start).max() > 0.15
    assert np.abs(simulation.correction).max() < 1e-4


@pytest.mark.parametrize("sag, expected", [(0.03, False), (0.2, True)])
def test_it_says_when_model_and_measurement_disagree(sag, expected):
    simulation = corrected(limit=0.05)
    show(simulation, Object(simulation, sag), 3.0)
    assert simulation.disagrees == expected
    simulation.reset()
    assert not simulation.disagrees


def test_clutter_does_not_matter():
    simulation = corrected()
    seen = Object(simulation)
    arcs = np.linspace(0.0, LENGTH, 30)
    for cycle in range(round(4.0 / CYCLE)):
        simulation.advance()
        if cycle % 5 == 0:
            picture = np.vstack((seen.seen(arcs), np.full((10, 3), 3.0), np.full((2, 3), np.nan)))
            simulation.measure(simulation.time, picture)
    assert not simulation.disagrees
    assert abs(simulation.points()[0][:, 2].min() - seen.points[:, 2].min()) < 0.003


def test_pictures_that_are_not_used():
    simulation = corrected()
    seen = Object(simulation)
    for _ in range(200):
        simulation.advance()
    now, picture = simulation.time, seen.points
    assert "not finite" in simulation.measure(np.nan, picture)
    assert "older than" in simulation.measure(now - 1.5, picture)
    assert "ahead" in simulation.measure(now + 0.2, picture)
    assert "no point" in simulation.measure(now, np.full((3, 3), np.nan))
    assert "no point" in simulation.measure(now, np.zeros((0, 3)))
    assert simulation.measure(now, picture) == ""
    assert "not newer" in simulation.measure(now, picture)
    with pytest.raises(ValueError, match="K, 3"):
        simulation.measure(now + 0.01, np.zeros((3, 2)))


def test_released_ends_are_corrected_as_free_ones():
    simulation = corrected()
    simulation.release(1)
    for _ in range(round(8.0 / CYCLE)):
        simulation.advance()
    seen = Object(simulation, sag=0.0)
    seen.points = seen.model + np.outer(seen.arcs / LENGTH, (0.0, 0.03, 0.0))
    show(simulation, seen, 3.0)
    assert error(simulation, seen) < 0.006


def test_without_it_nothing_changes():
    plainly, also = make_simulation(SCENARIO), corrected()
    for _ in range(20):
        plainly.advance()
        also.advance()
    np.testing.assert_array_equal(plainly.points(), also.points())
    assert plainly.correction is None


def test_fabrics_have_none():
    name = "fabric_three_assistants"
    with pytest.raises(ScenarioError, match="only to rods"):
        load_scenario(name, [("correction", "{}")])
    with pytest.raises(ParameterError, match="only for rods"):
        make_simulation(load_scenario(name), copies=False).correct(plain(CorrectionSpec()))


def test_a_camera_needs_a_correction():
    with pytest.raises(ScenarioError, match="no effect without a section `correction`"):
        load_scenario(SHORT_ROPE, [("knowledge.camera_rate", "10")])
