"""Several assistants by one program."""

import control_builders as build
import numpy as np
import pytest

from deformable_manipulation.control.status import Status
from deformable_manipulation.control.team import TeamController, teams
from deformable_manipulation.scenario.spec import CENTRALISED, DECENTRALISED

DT = 0.01
NAMES = ("assistant_1", "assistant_2")
GROUND = build.HalfSpace((0.0, 0.0, 1.0), 0.0)
FAR = build.HalfSpace((0.0, 0.0, 1.0), -5.0)


@pytest.fixture
def scenario():
    return build.scenario(assistants=2, cooperation=CENTRALISED, max_acceleration=100.0)


def observed(scenario, time=0.0, shift=0.0, obstacle=FAR, sag=0.3, **settings):
    positions = np.array([agent.start for agent in scenario.agents]) + shift
    body = build.hanging_chain(len(positions), sag)
    return build.observe(time, positions, body, obstacle, **settings)


def test_the_scenario_says_who_is_commanded_together(scenario):
    assert teams(scenario) == (NAMES,)
    assert teams(build.scenario(assistants=2)) == (NAMES,)
    apart = build.scenario(assistants=2, cooperation=DECENTRALISED)
    assert teams(apart) == (("assistant_1",), ("assistant_2",))


def test_each_has_a_decision_of_its_own(scenario):
    shift = np.array([[0.0, 0.0, 0.0], [0.0, -0.1, 0.0], [0.02, 0.0, 0.0]])
    team = TeamController(scenario, NAMES)
    decisions = team.update(observed(scenario, shift=shift))
    assert tuple(decisions) == team.names == NAMES
    for name, at, decision in zip(NAMES, shift[1:], decisions.values()):
        alone = build.Alone(scenario, name).update(observed(scenario, shift=shift))
        np.testing.assert_allclose(decision.command, -at, atol=1e-12)
        for field in ("nominal", "position", "target", "jacobian"):
            np.testing.assert_array_equal(getattr(decision, field), getattr(alone, field))
        for field in ("distance", "h", "leader_drift"):
            assert getattr(decision, field) == getattr(alone, field)


def test_together_they_meet_the_whole_demand(scenario):
    low = observed(scenario, shift=[0.0, 0.0, -0.655], obstacle=GROUND)
    together = TeamController(scenario, NAMES).update(low)
    assert Status.CONSTRAINED in {decision.status for decision in together.values()}
    demand = 5.0 * (0.052 - together["assistant_1"].distance)
    rate = sum(decision.jacobian @ decision.command for decision in together.values())
    assert rate == pytest.approx(demand, abs=1e-9)


def test_who_stands_still_is_reckoned_with(scenario):
    """The other one makes good for it."""
    team = TeamController(scenario, NAMES)
    team.set_enabled("assistant_2", False)
    decisions = team.update(observed(scenario, shift=[0.0, 0.0, -0.655], obstacle=GROUND))
    still, moving = decisions["assistant_2"], decisions["assistant_1"]
    assert still.status == Status.DISABLED and not still.enabled and moving.enabled
    np.testing.assert_array_equal(still.command, 0.0)
    assert moving.status == Status.CONSTRAINED
    demand = 5.0 * (0.052 - moving.distance)
    assert moving.jacobian @ moving.command == pytest.approx(demand, abs=1e-9)
    team.set_enabled("assistant_1", False)
    decisions = team.update(observed(scenario, DT, obstacle=GROUND))
    assert {decision.status for decision in decisions.values()} == {Status.DISABLED}


def test_all_wait_for_the_copies_of_one_and_say_whose(scenario):
    ready = np.array([True] * 4 + [False] * 3)
    team = TeamController(scenario, NAMES)
    decisions = team.update(observed(scenario, obstacle=GROUND, ready=ready))
    for decision in decisions.values():
        assert decision.status == Status.WAITING
        assert "copies of assistant_2" in decision.text and "assistant_1" not in decision.text


def test_a_reference_is_taken_by_one(scenario):
    team = TeamController(scenario, NAMES)
    shifted = observed(scenario, shift=np.array([[0, 0, 0], [0.1, 0, 0], [0, 0, 0.1]]))
    team.take_reference("assistant_2", shifted)
    errors = [decision.error_norm for decision in team.update(shifted).values()]
    np.testing.assert_allclose(errors, [0.1, 0.0], atol=1e-12)
    team.reset()
    errors = [decision.error_norm for decision in team.update(shifted).values()]
    np.testing.assert_allclose(errors, [0.1, 0.1], atol=1e-12)


def test_two_too_near_part_half_each(scenario):
    shift = np.array([[0.0, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 0.0]])
    scenario = build.scenario(
        assistants=2, cooperation=CENTRALISED, max_acceleration=100.0, gain=1e-9
    )
    decisions = TeamController(scenario, NAMES).update(observed(scenario, shift=shift))
    speeds = [decision.command[1] for decision in decisions.values()]
    np.testing.assert_allclose(speeds, [-0.05, 0.05], atol=1e-6)  # 2/s times 50 mm


def test_unknown_agents_are_refused(scenario):
    with pytest.raises(ValueError, match="agent: 'assistant_7'"):
        TeamController(scenario, ("assistant_1", "assistant_7"))
