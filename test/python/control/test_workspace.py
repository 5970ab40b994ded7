"""The workspace barrier: its values and gradients, in closed loop, and what is read of it."""

import control_builders as build
import numpy as np
import pytest
import yaml

from deformable_manipulation import _control
from deformable_manipulation.control.status import Status
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.recording.timeseries import TimeSeries
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping
from deformable_manipulation.scenario.mapping import scenario_to_mapping

PARAMETERS = {
    "lower": [-1.0, -1e6, -1e6],
    "upper": [1e6, 1e6, 2.0],
    "planes": [{"point": [0.0, 1.0, 0.0], "normal": [3.0, -4.0, 0.0]}],
    "spheres": [{"center": [0.5, 0.2, 0.1], "radius": 0.3}],
    "margin": 0.0,
    "alpha": [1.0, 5.0],
}


def barrier(commanded=(1,), **changes):
    everybody = build.team(commanded, [1, 2], 3, _control.Formulation.full())
    return _control.Barrier("workspace", {**PARAMETERS, **changes}, everybody)


def by_hand(x):
    """h of each limit."""
    plane = np.array([0.6, -0.8, 0.0]) @ (x - [0.0, 1.0, 0.0])
    sphere = np.linalg.norm(x - [0.5, 0.2, 0.1]) - 0.3
    return np.array([x[0] + 1.0, 2.0 - x[2], plane, sphere])


def state_of(positions):
    return _control.PredictedState(positions, np.zeros_like(positions))


@pytest.mark.parametrize("seed", range(20))
def test_the_value_is_the_lowest_of_all_limits(seed):
    positions = np.random.default_rng(seed).normal(size=(3, 3))
    for agent in (1, 2):
        value = barrier().value(positions, np.inf, agent)
        assert value == pytest.approx(by_hand(positions[agent]).min(), abs=1e-12)


@pytest.mark.parametrize("seed", range(20))
def test_rows_are_the_gradients_by_differences(seed):
    """Violated, so that no row is left out: the bound is 5 times what is missing."""
    positions = np.random.default_rng(seed).normal(size=(3, 3))
    far = 100.0  # m, a margin that nothing keeps
    rows = barrier((2, 1), margin=far).rows(build.NO_FEATURES, state_of(positions))
    assert rows.kinds == [0] * 8
    step = 1e-6
    for column, agent in enumerate((2, 1)):
        x = positions[agent]
        ends = [[by_hand(x + sign * step * axis) for axis in np.eye(3)] for sign in (1.0, -1.0)]
        gradient = np.transpose(np.subtract(*ends)) / (2.0 * step)
        own = slice(4 * column, 4 * column + 4)
        coefficients = rows.coefficients[own]
        np.testing.assert_allclose(
            coefficients[:, 3 * column : 3 * column + 3], gradient, atol=1e-8
        )
        assert np.count_nonzero(np.delete(coefficients, range(3 * column, 3 * column + 3), 1)) == 0
        np.testing.assert_allclose(rows.bounds[own], -5.0 * (by_hand(x) - far))


def test_limits_that_are_out_of_reach_have_no_row():
    middle = np.zeros((3, 3))
    assert len(barrier(planes=[], spheres=[]).rows(build.NO_FEATURES, state_of(middle))) == 0
    near = middle.copy()
    near[1, 0] = -0.9
    assert len(barrier(planes=[], spheres=[]).rows(build.NO_FEATURES, state_of(near))) == 1


def test_the_centre_of_a_sphere_has_a_direction():
    centre = np.zeros((3, 3))
    centre[1] = PARAMETERS["spheres"][0]["center"]
    rows = barrier(planes=[]).rows(build.NO_FEATURES, state_of(centre))
    assert np.isfinite(rows.coefficients).all() and np.isfinite(rows.bounds).all()
    np.testing.assert_allclose(np.linalg.norm(rows.coefficients, axis=1), 1.0)


def with_workspace(duration=60.0, **workspace):
    return load_scenario(
        "rope_one_assistant",
        [
            ("controller.workspace", yaml.safe_dump(workspace)),
            ("simulation.duration", str(duration)),
        ],
    )


WALL = {"planes": [{"point": [0, 2.2, 0], "normal": [0, -2, 0]}], "margin": 0.002}


@pytest.fixture(scope="module")
def series():
    """A run in which the assistant would go through a wall."""
    scenario = with_workspace(**WALL)
    table = TimeSeries.of(scenario)
    loop = ClosedLoop(scenario)
    for _ in range(scenario.cycles):
        table.append(loop.step())
    return table


def test_a_run_stays_within(series):
    free = load_scenario("rope_one_assistant", [("simulation.duration", "60.0")])
    loop = ClosedLoop(free)
    farthest = max(loop.step().positions[1, 1] for _ in range(free.cycles))
    assert farthest > 2.22  # without the barrier
    h = series.column("assistant_1.h_workspace")
    assert h.min() >= -1e-3
    assert h.min() == pytest.approx((2.2 - series.column("assistant_1.position_y")).min())
    assert series.column("assistant_1.h_collision").min() >= -1e-3
    assert not (series.column("assistant_1.status") == Status.FAILED).any()


def test_it_is_told_by_name(series):
    assert series.barriers == ("collision", "workspace", "overstretch", "proximity")
    assert "assistant_1.slack_workspace" in series.columns
    decision = ClosedLoop(with_workspace(**WALL)).step().decisions["assistant_1"]
    assert decision.h["workspace"] == pytest.approx(0.7)
    assert tuple(decision.h) == tuple(decision.slack) == series.barriers


def test_a_scenario_with_it_comes_back_from_its_mapping():
    scenario = with_workspace(**WALL, spheres=[{"center": [5, 5, 5], "radius": 1}])
    assert scenario.controller.priority == ("collision", "workspace", "overstretch", "proximity")
    assert scenario_from_mapping(scenario_to_mapping(scenario), ".") == scenario
    without = scenario_to_mapping(load_scenario("rope_one_assistant"))
    assert "workspace" not in without["controller"]


@pytest.mark.parametrize(
    "workspace, key, words",
    [
        ({"planes": [{"point": [0, 0, 0], "normal": [0, 0, 0]}]}, "planes.0.normal", "direction"),
        ({"planes": [{"point": [0, 0, 0]}]}, "planes.0.normal", "is missing"),
        ({"planes": {}}, "planes", "a list"),
        ({"spheres": [{"center": [0, 0, 0], "radius": 0}]}, "spheres.0.radius", "> 0"),
        ({"lower": [2, 0, 0], "upper": [1, 9, 9]}, "upper", "above controller.workspace.lower"),
        ({"margin": -1}, "margin", ">= 0"),
        ({"ceiling": 1}, "ceiling", "not a key"),
    ],
)
def test_mistakes_are_told_with_their_keys(workspace, key, words):
    with pytest.raises(ScenarioError) as caught:
        with_workspace(**workspace)
    told = {problem.key: problem.message for problem in caught.value.problems}
    assert words in told["controller.workspace." + key]


def test_a_start_outside_is_refused():
    with pytest.raises(ScenarioError, match="assistant_1.start.*outside controller.workspace"):
        with_workspace(upper=[1e6, 1e6, 1.7])


def test_the_priority_names_the_barriers_in_use():
    named = [("controller.priority", "[collision, overstretch, proximity]")]
    with pytest.raises(ScenarioError, match="each barrier in use once: collision, workspace"):
        load_scenario(
            "rope_one_assistant", [("controller.workspace", yaml.safe_dump(WALL)), *named]
        )
    load_scenario("rope_one_assistant", named)
