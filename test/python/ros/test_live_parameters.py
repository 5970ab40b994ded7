import pytest

from deformable_manipulation.cfg import ControllerConfig
from deformable_manipulation.ros.live_parameters import KEYS, changed, values_of
from deformable_manipulation.scenario import ScenarioError, load_scenario


@pytest.fixture(scope="module", params=["rope_two_assistants", "fabric_three_assistants"])
def scenario(request):
    return load_scenario(request.param)


def test_the_names_are_those_of_the_configuration():
    assert set(ControllerConfig.defaults) == {*KEYS, "outcome"}


@pytest.mark.parametrize("name", KEYS)
def test_every_range_holds_the_shipped_scenarios(scenario, name):
    assert ControllerConfig.min[name] <= values_of(scenario)[name] <= ControllerConfig.max[name]


def test_no_change_changes_nothing(scenario):
    assert changed(scenario, {}) == scenario
    assert changed(scenario, values_of(scenario)) == scenario


def test_each_value_goes_to_its_place(scenario):
    present = values_of(scenario)
    wanted = {name: 0.9 * value if value > 0 else value for name, value in present.items()}
    wanted["max_fraction"] = present["max_fraction"]  # with less, the fabric starts beyond it
    result = changed(scenario, wanted)
    assert values_of(result) == pytest.approx(wanted)
    assert result.controller.collision.offset == wanted["collision_offset"]
    assert result.controller.weights[2] == wanted["weight_z"]
    assert result.controller.collision.alpha[1] == wanted["collision_alpha_back"]
    assert result.obstacles == scenario.obstacles


def test_auto_can_be_left_and_taken_again(scenario):
    assert values_of(scenario)["min_distance"] == -1.0
    back = changed(changed(scenario, {"min_distance": 0.05}), {"min_distance": -1.0})
    assert back == scenario


@pytest.mark.parametrize(
    "values, key",
    [
        ({"gain": 500.0}, "controller.gain"),
        ({"gain": float("nan")}, "controller.gain"),
        ({"weight_x": 1e-3, "weight_y": 1.0}, "controller.weights"),
        ({"max_distance": 0.2, "min_distance": 0.3}, "controller.proximity.min_distance"),
        ({"max_distance": 99.0}, "controller.overstretch.max_distance"),
        ({"collision_offset": -0.1}, "controller.collision.offset"),
        ({"min_distance": -0.5}, "controller.proximity.min_distance"),
    ],
)
def test_what_does_not_go_together_is_refused_as_in_a_file(scenario, values, key):
    with pytest.raises(ScenarioError) as caught:
        changed(scenario, values)
    assert key in {problem.key for problem in caught.value.problems}
