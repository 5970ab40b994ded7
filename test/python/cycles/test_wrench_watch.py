"""Measured wrenches beside those of the model."""

import numpy as np
import pytest

from deformable_manipulation.cycles.wrench_watch import WrenchWatch
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping
from deformable_manipulation.scenario.mapping import scenario_to_mapping
from deformable_manipulation.scenario.wrench_watch import WrenchWatchSpec

MODELLED = np.array([0.0, 1.0, -3.0, 0.1, 0.0, 0.2])
AT_ONCE = 1e-9


def make_watch(patience=0.3):
    return WrenchWatch(WrenchWatchSpec(2.0, 0.5, patience), ["one", "other"], timeout=0.2)


def measure(watch, time, off=(0.0,) * 6, **details):
    seen = MODELLED + off
    watch.measured("one", time, seen[:3], seen[3:], **details)
    return watch.check("one", time, MODELLED)


def test_a_small_difference_is_no_matter():
    watch = make_watch()
    for k in range(100):
        assert measure(watch, 0.01 * k, (1.0, 1.0, 1.0, 0.0, 0.4, 0.0)) == ""


@pytest.mark.parametrize(
    "off, words",
    [
        ((2.0, 2.0, 0.0, 0.0, 0.0, 0.0), "force differs from the modelled one by 2.83 N"),
        ((0.0, 0.0, 0.0, 0.4, 0.4, 0.0), "torque differs from the modelled one by 0.566 N m"),
    ],
)
def test_a_lasting_difference_stops_until_it_is_enabled_again(off, words):
    watch = make_watch()
    faults = [measure(watch, 0.01 * k, off) for k in range(40)]
    assert not any(faults[:30]) and all(faults[31:])
    assert words in faults[-1] and "at the grip of one" in faults[-1]
    assert measure(watch, 0.5) == faults[-1]  # though the difference is gone
    watch.rearm("one")
    assert measure(watch, 0.51) == ""


def test_a_short_difference_does_not_stop():
    watch = make_watch()
    for k in range(100):
        off = (9.0, 0.0, 0.0, 0.0, 0.0, 0.0) if k % 30 else (0.0,) * 6
        assert measure(watch, 0.01 * k, off) == ""


def test_what_is_not_measured_stops_for_as_long():
    watch = make_watch()
    assert watch.check("one", 0.0, MODELLED) == "no measured wrench of one yet"
    assert measure(watch, 0.0) == ""
    assert watch.check("one", 0.2, MODELLED) == ""
    assert "is 0.3 s off the state" in watch.check("one", 0.3, MODELLED)
    assert "not finite" in measure(watch, 0.31, (np.nan, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert "frame 'tool'" in measure(watch, 0.32, problem="is in the frame 'tool'")
    assert measure(watch, 0.33) == ""


def test_measurements_out_of_order_are_passed_over():
    watch = make_watch(AT_ONCE)
    measure(watch, 1.0)
    watch.measured("one", 0.95, [99.0] * 3, [0.0] * 3)
    assert watch.check("one", 1.0, MODELLED) == ""
    watch.measured("one", 0.0, MODELLED[:3], MODELLED[3:])  # time was set back
    assert watch.check("one", 0.0, MODELLED) == ""


def test_a_reset_forgets():
    watch = make_watch(AT_ONCE)
    off = (9.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    measure(watch, 0.0, off)
    assert measure(watch, 0.1, off)
    watch.reset()
    assert watch.check("one", 0.1, MODELLED) == "no measured wrench of one yet"


def test_it_is_off_unless_the_scenario_has_its_section():
    assert load_scenario("rope_one_assistant").controller.wrench_watch is None
    given = ("controller.wrench_watch", "{max_force: 8.0, max_torque: 1.0}")
    scenario = load_scenario("rope_one_assistant", [given])
    assert scenario.controller.wrench_watch == WrenchWatchSpec(8.0, 1.0)
    assert scenario.controller.needs_wrenches
    assert scenario_from_mapping(scenario_to_mapping(scenario), ".") == scenario
    with pytest.raises(ScenarioError, match="max_torque.*is missing"):
        load_scenario("rope_one_assistant", [("controller.wrench_watch", "{max_force: 8.0}")])
