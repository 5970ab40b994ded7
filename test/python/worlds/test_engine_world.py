"""Objects that MuJoCo simulates, beside theory and as the true object of a run."""

import argparse
import json
import sys
from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.campaign.variation import Ranges, vary
from deformable_manipulation.commands import check_scenario, run_campaign, run_scenario
from deformable_manipulation.commands.arguments import scenario_overrides
from deformable_manipulation.control.status import Status
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.recording.run_reader import read_run
from deformable_manipulation.recording.summary import summarise
from deformable_manipulation.recording.timeseries import TimeSeries
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.scenario.grip_points import held_points
from deformable_manipulation.validation.fabric import rectangle
from deformable_manipulation.validation.references.elastica import (
    Clamped,
    Pinned,
    solve_between,
)
from deformable_manipulation.worlds.engine import load_engine
from deformable_manipulation.worlds.engine_world import EngineWorld
from deformable_manipulation.worlds.factory import make_world, true_scenario
from deformable_manipulation.worlds.flex_model import flex_xml

SHORT_ROPE = Path(__file__).resolve().parents[2] / "rostest" / "short_rope.yaml"
SMALL_FABRIC = SHORT_ROPE.with_name("small_fabric.yaml")
GRAVITY = 9.81


def scenario(name=SHORT_ROPE, **sets):
    values = {"knowledge.world": "mujoco", **sets}
    return load_scenario(name, [(key, str(value)) for key, value in values.items()])


def distance_from_theory(name, refinement):
    """Largest distance [m] of a rod's pieces' ends from the elastica between its two grips."""
    truth = true_scenario(scenario(name, **{"knowledge.refinement": refinement}))
    world = make_world(truth)
    rod, (first, last) = truth.object, (agent.particle for agent in truth.agents)
    piece = rod.length / rod.segments
    clamped = truth.agents[0].hold == "clamped"
    end = Clamped() if clamped else Pinned((first + 0.5) * piece)
    start, goal = world.positions()
    assert start[2] == goal[2]
    chord = np.linalg.norm(goal - start)
    weight = rod.density * np.pi * rod.radius**2 * GRAVITY
    free = (last - first) * piece
    shape = solve_between(free, rod.bending_stiffness, weight, (chord, 0.0), end, end)
    arcs = (np.arange(rod.segments + 1) - first - 0.5) * piece
    between = (arcs > 0.0) & (arcs < free)
    points = world.points()[0][between] - start
    plane = np.stack((points @ ((goal - start) / chord), points[:, 2]), axis=1)
    return np.linalg.norm(plane - shape.positions(arcs[between]), axis=1).max()


@pytest.mark.parametrize(
    "name, refinement, tolerance",
    [("rope_one_assistant", 3, 2e-3), ("stiff_rod_one_assistant", 3, 2e-4)],
)
def test_a_cable_hangs_as_theory_says(name, refinement, tolerance):
    assert distance_from_theory(name, refinement) < tolerance


def test_a_coarse_cable_has_the_error_of_its_clamps():
    assert 8e-3 < distance_from_theory("rope_one_assistant", 1) < 14e-3


def test_a_grip_goes_where_it_is_commanded_and_the_cable_with_it():
    truth = true_scenario(scenario())
    world = EngineWorld(truth)
    before = world.points()[0]
    begin, velocity = world.positions(), np.array([0.05, 0.1, -0.02])
    for agent in range(2):
        world.set_command(agent, velocity)
    for _ in range(200):
        world.advance()
    np.testing.assert_allclose(world.positions() - begin, [2.0 * velocity] * 2, atol=1e-12)
    np.testing.assert_array_equal(world.velocities(), [velocity] * 2)
    assert world.time == pytest.approx(2.0)
    # Damping is relative to the grips: carried steadily, it keeps its shape.
    moved = world.points()[0] - before
    np.testing.assert_allclose(moved, [2.0 * velocity] * len(before), atol=1e-3)
    for agent, place in zip(truth.agents, world.positions()):
        held = world.points()[0, agent.particle : agent.particle + 2].mean(axis=0)
        assert np.linalg.norm(held - place) < 5e-4


def test_a_sheet_hangs_like_the_packages_own():
    fabric = load_scenario(SMALL_FABRIC)
    own = make_world(true_scenario(fabric)).points()[0]
    other = make_world(true_scenario(scenario(SMALL_FABRIC))).points()[0]
    size = np.ptp(own, axis=0).max()
    assert 0.0 < np.abs(own - other).max() < 0.06 * size
    assert abs(own[:, 2].min() - other[:, 2].min()) < 0.03 * size


def test_a_bar_of_a_sheet_goes_with_its_grip():
    """Along one edge, which stays straight."""
    truth = true_scenario(
        scenario(SMALL_FABRIC, **{"agents.assistant_1.further_particles": [9, 14]})
    )
    world = EngineWorld(truth)
    starts = held_points(truth.object, truth.agents[1])
    assert sorted(starts) == [4, 9, 14]
    for _ in range(50):
        world.set_command(1, (0.0, 0.0, 0.1))
        world.advance()
    moved = world.points()[0, list(starts)] - np.array(list(starts.values()))
    np.testing.assert_allclose(moved, [[0.0, 0.0, 0.05]] * 3, atol=1e-12)


def test_a_sheet_stretches_as_theory_says():
    """A strip that hangs grows by weight x length / (2 E t width)."""
    mujoco = load_engine()
    mesh = rectangle((0.2, 1.0), (3, 11), alternate=True)
    spec = FabricSpec(
        tuple(map(tuple, mesh.vertices)),
        tuple(map(tuple, mesh.triangles)),
        density=1.0,
        thickness=0.01,
        stretching_compliance=2e-3,
        bending_compliance=1e3,
    )
    upper = range(30, 33)
    xml = flex_xml(
        mesh.vertices,
        mesh.triangles,
        spec.masses(),
        upper,
        (spec.stretching_compliance, spec.bending_compliance),
        0.005,
        "discrete",
        (0.0, -1.0, 0.0),
    )
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    for _ in range(800):
        mujoco.mj_step(model, data)
        data.qvel *= 0.95
    grown = -data.qpos.reshape(-1, 3)[:3, 1].mean()
    assert grown == pytest.approx(0.5 * 1.0 * 1.0 * 2e-3, rel=0.01)


def test_controllers_run_in_that_world(tmp_path):
    options = ["--set", "simulation.duration=1", "--output", str(tmp_path / "run")]
    assert run_scenario.main([str(SHORT_ROPE), "--world", "mujoco", *options]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["min_distance"] != summary["min_model_distance"]
    assert abs(summary["min_distance"] - summary["min_model_distance"]) < 0.03
    assert (summary["max_correction"], summary["disagreeing"]) == (0.0, 0)
    header = (tmp_path / "run" / "timeseries.csv").read_text().splitlines()[0]
    assert "model_distance" in header.split(",")
    frames = read_frames(read_run(tmp_path / "run"))
    segments = frames.scenario.object.segments
    assert frames.points.shape[1:] == (3 * segments + 1, 3)
    with np.load(tmp_path / "run" / "states.npz") as states:
        assert states["model_points"].shape[1:] == (segments + 1, 3)


def test_random_runs_are_in_that_world():
    varied = vary(scenario(), Ranges(duration=30.0, imperfect=True), 1, 0)
    assert (varied.knowledge.world, varied.knowledge.refinement) == ("mujoco", 3)
    assert varied.knowledge.density_factor != 1.0


def test_finer_pieces_of_the_packages_own_rod_are_another_object():
    truth = scenario(**{"knowledge.world": "own", "knowledge.refinement": 3})
    loop = ClosedLoop(truth)
    record = loop.step()
    assert len(record.points) == 3 * truth.object.segments + 1
    assert record.distance != record.model.distance


@pytest.mark.parametrize(
    "sets, expected",
    [
        ({"knowledge.world": "bullet"}, "mujoco"),
        ({"knowledge.refinement": 2}, "must be odd"),
        ({"knowledge.refinement": 101}, "3, 5 to 99"),
    ],
)
def test_mistakes(sets, expected):
    with pytest.raises(ScenarioError, match=expected):
        scenario(**sets)


def test_a_fabric_is_not_refined():
    with pytest.raises(ScenarioError, match="knowledge.refinement"):
        scenario(SMALL_FABRIC, **{"knowledge.refinement": 3})


@pytest.mark.parametrize(
    "name, sets, expected",
    [
        (SHORT_ROPE, {"object.drag_coefficient": 1.2}, "object.drag_coefficient: 1.2 .* must be 0"),
        (SHORT_ROPE, {"object.stretch": "from_moduli"}, "object.stretch: .* must be zero"),
        (SHORT_ROPE, {"object.natural_shape": {"twist": 0.5}}, "object.natural_shape: .* straight"),
        (SHORT_ROPE, {"object.point_masses": [{"at": 0.5, "mass": 0.1}]}, "object.point_masses: "),
        ("rope_one_assistant", {"knowledge.refinement": 99}, "refinement: 99 .* makes 2772 pieces"),
        (SMALL_FABRIC, {"object.bending_compliance": 0}, "bending_compliance: 0.0 .* above 0"),
        ("fabric_three_assistants", {"object.resolution": 25}, "object: has 2601 vertices"),
    ],
)
def test_objects_that_the_engine_does_not_have(name, sets, expected):
    with pytest.raises(ScenarioError, match=expected):
        scenario(name, **sets)


def test_without_the_engine_it_is_said_how_to_get_it(monkeypatch, tmp_path, capsys):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    options = ["--output", str(tmp_path / "run")]
    assert run_scenario.main([str(SHORT_ROPE), "--world", "mujoco", *options]) == 1
    assert "pip install" in capsys.readouterr().err
    assert not (tmp_path / "run").exists()


def test_a_check_tells_what_a_run_would(monkeypatch, capsys):
    options = [str(SHORT_ROPE), "--world", "mujoco"]
    assert check_scenario.main(options) == 0
    assert "the true object, in the world mujoco, has " in capsys.readouterr().out
    assert check_scenario.main([*options, "--set", "object.drag_coefficient=1"]) == 1
    assert "must be 0 in the world mujoco" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "mujoco", None)
    assert check_scenario.main(options) == 1
    assert "pip install" in capsys.readouterr().err


@pytest.mark.parametrize("command", [check_scenario, run_scenario, run_campaign])
def test_two_worlds_are_a_mistake(command, capsys):
    options = ["--set", "knowledge.world=own", "--world", "mujoco"]
    assert command.main([str(SHORT_ROPE), *options]) == 1
    error = capsys.readouterr().err
    assert "knowledge.world: 'own' \u2014 cannot be set beside --world mujoco; remove one" in error


def test_the_world_is_added_to_other_knowledge():
    given = argparse.Namespace(set=[("knowledge", "{pose_noise: 0.001}")], world="mujoco")
    knowledge = load_scenario(SHORT_ROPE, scenario_overrides(given)).knowledge
    assert (knowledge.world, knowledge.pose_noise) == ("mujoco", 0.001)


def shape_error(**sets):
    """Largest distance [m] between the model and the true rope's points after 3 s."""
    loop = ClosedLoop(scenario("rope_one_assistant", **sets))
    for _ in range(300):
        record = loop.step()
    return np.linalg.norm(record.points[::3] - record.model.points, axis=1).max()


def test_a_camera_brings_the_model_to_the_true_rope():
    camera = {
        "correction": "{}",
        "knowledge.camera_rate": 15,
        "knowledge.camera_points": 60,
        "knowledge.camera_noise": 0.003,
        "knowledge.camera_delay": 0.1,
        "knowledge.camera_hidden": 0.3,
    }
    assert shape_error() > 0.009
    assert shape_error(**camera) < 0.008


def test_assistants_stop_where_the_model_is_not_that_of_the_object():
    sets = {"correction": "{limit: 0.002, stop: true}", "knowledge.camera_rate": 20}
    stopping = scenario(**sets)
    loop = ClosedLoop(stopping)
    records = [loop.step() for _ in range(200)]
    assert not records[20].model.disagrees
    assert records[-1].model.disagrees
    for decision in records[-1].decisions.values():
        assert decision.status == Status.WAITING
        assert not decision.command.any()
    series = TimeSeries.of(stopping)
    for record in records:
        series.append(record)
    summary = summarise(stopping, series, 1.0, False, True, "stable", {})
    assert summary["max_correction"] > 0.002
    assert summary["disagreeing"] == sum(record.model.disagrees for record in records) > 50
