"""Controllers that know the object and where it is held only imperfectly."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.commands import run_scenario
from deformable_manipulation.control.status import Status
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.running.imperfect import MeasuredPoses
from deformable_manipulation.scenario import ScenarioError, load_scenario, pair_limits
from deformable_manipulation.scenario.spec import KnowledgeSpec
from deformable_manipulation.worlds.factory import true_scenario

SHORT_ROPE = Path(__file__).resolve().parents[2] / "rostest" / "short_rope.yaml"
ASSISTANT = "assistant_1"


def scenario(duration=2.0, **knowledge):
    sets = [(f"knowledge.{key}", str(value)) for key, value in knowledge.items()]
    return load_scenario(SHORT_ROPE, [("simulation.duration", str(duration)), *sets])


def run(imperfect):
    loop = ClosedLoop(imperfect)
    return [loop.step() for _ in range(imperfect.cycles)]


def commands(records):
    return np.array([record.decisions[ASSISTANT].command for record in records])


def test_what_is_known_perfectly_is_run_as_ever():
    np.testing.assert_array_equal(commands(run(scenario())), commands(run(scenario(seed=7))))


def test_the_same_seed_gives_the_same_run_and_another_one_another():
    given = {"pose_noise": 0.002, "dropped_cycles": 0.2}
    first, again, other = (commands(run(scenario(seed=seed, **given))) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


def test_what_is_recorded_is_the_truth():
    imperfect = scenario(pose_noise=0.005, pose_delay=0.035, density_factor=2.0)
    distance = make_minimum_distance(imperfect)
    limits = pair_limits(imperfect, *imperfect.assistants, imperfect.leader_index)
    for record in run(imperfect)[::50]:
        decision = record.decisions[ASSISTANT]
        apart = np.linalg.norm(record.positions[0] - record.positions[1])
        assert record.distance == distance.compute(record.points[None]).minimum[0]
        assert decision.distance == record.distance
        assert decision.h["overstretch"] == pytest.approx(limits.max_distance - apart, abs=1e-12)
        assert decision.h["proximity"] == pytest.approx(apart - limits.min_distance, abs=1e-12)
        np.testing.assert_array_equal(decision.position, record.positions[imperfect.assistants[0]])


def test_without_noise_delay_or_filter_the_model_is_the_object():
    """So small a probability drops no cycle, but makes a model."""
    perfect = commands(run(scenario(1.0)))
    with_model = dataclasses.replace(
        scenario(1.0, dropped_cycles=1e-12),
        controller=dataclasses.replace(scenario().controller, pose_smoothing=0.0),
    )
    np.testing.assert_allclose(commands(run(with_model)), perfect, atol=1e-7)


def test_the_material_is_true_for_the_object_and_assumed_by_the_controllers():
    imperfect = scenario(stiffness_factor=2.0, density_factor=0.5)
    assumed, true = imperfect.object, true_scenario(imperfect).object
    assert true.young_modulus == 2.0 * assumed.young_modulus
    assert true.torsion_modulus == 2.0 * assumed.torsion_modulus
    assert true.density == 0.5 * assumed.density
    assert ClosedLoop(imperfect).distance() != ClosedLoop(scenario()).distance()


def test_a_fabrics_material():
    fabric = load_scenario("fabric_three_assistants")
    known = KnowledgeSpec(stiffness_factor=2.0, density_factor=3.0)
    true = true_scenario(dataclasses.replace(fabric, knowledge=known)).object
    assert true.stretching_compliance == 0.5 * fabric.object.stretching_compliance
    assert true.bending_compliance == 0.5 * fabric.object.bending_compliance
    assert true.density == 3.0 * fabric.object.density


@pytest.mark.parametrize("cycles", [0.0, 1.0, 2.5])
def test_poses_come_late(cycles):
    poses = MeasuredPoses(
        np.zeros(1), KnowledgeSpec(pose_delay=0.01 * cycles), 0.01, np.random.default_rng(0)
    )
    measured = [poses.measure(np.full(1, float(cycle))) for cycle in range(1, 9)]
    np.testing.assert_allclose(
        np.ravel(measured), np.maximum(np.arange(1, 9) - cycles, 0.0), atol=1e-12
    )


def test_poses_come_with_noise():
    poses = MeasuredPoses(
        np.ones((400, 3)), KnowledgeSpec(pose_noise=0.002), 0.01, np.random.default_rng(0)
    )
    errors = np.array([poses.measure(np.ones((400, 3))) for _ in range(20)]) - 1.0
    assert errors.std() == pytest.approx(0.002, rel=0.02)
    assert abs(errors.mean()) < 1e-4


def test_a_dropped_cycle_keeps_the_last_command():
    records = run(scenario(dropped_cycles=0.3))[1:]
    moving = np.diff(commands(records), axis=0)
    kept = (moving == 0.0).all(axis=1).mean()
    assert 0.2 < kept < 0.4


def test_without_states_for_longer_than_the_timeout_the_assistant_waits():
    records = run(scenario(dropped_cycles=0.99, seed=3))
    waiting = [r for r in records if r.decisions[ASSISTANT].status == Status.WAITING]
    assert waiting
    assert all((r.decisions[ASSISTANT].command == 0.0).all() for r in waiting)


@pytest.mark.parametrize(
    "key, value, expected",
    [
        ("pose_delay", 0.2, "below controller.timeout"),
        ("pose_noise", -0.001, ">= 0"),
        ("stiffness_factor", 0, ">= 0.01"),
        ("dropped_cycles", 1, "<= 0.99"),
        ("noise", 1, "did you mean 'pose_noise'"),
    ],
)
def test_mistakes(key, value, expected):
    with pytest.raises(ScenarioError, match=expected):
        scenario(**{key: value})


def test_run_scenario_says_that_nobody_publishes_poses(tmp_path, capsys):
    options = ["--set", "simulation.duration=0.1", "--output", str(tmp_path / "run")]
    sets = ["--set", "agents.leader.driven_by=pose"]
    assert run_scenario.main([str(SHORT_ROPE), *options, *sets]) == 0
    assert "without ROS leader moves as commanded" in capsys.readouterr().err
