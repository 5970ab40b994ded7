"""Assistants that plan for one another, each with a controller of its own."""

import control_builders as build
import numpy as np
import pytest
from control_run import Run

from deformable_manipulation._control import AssistantIntent
from deformable_manipulation.control.status import Status
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.scenario.spec import CENTRALISED, COORDINATED, DECENTRALISED

DIVE = ((0.0, (0, 0, 0)), (0.5, (0, 0, 0)), (6.5, (0, 0.2, -0.5)), (9.0, (0, 0.4, -0.5)))
DURATION = 9.0
GROUND = build.HalfSpace((0.0, 0.0, 1.0), 0.0)
DT = 0.01
LOW = -0.655  # m, at which the object has to be lifted


def dive(cooperation, assistants=3, duration=DURATION, **settings):
    scenario = build.scenario(assistants, DIVE, cooperation=cooperation)
    return Run(scenario, duration, **settings)


def always(_name, _cycle):
    return True


def never(_name, _cycle):
    return False


@pytest.fixture
def scenario():
    return build.scenario(2, cooperation=COORDINATED, max_acceleration=100.0)


def low_state(scenario, time):
    positions = np.array([agent.start for agent in scenario.agents]) + [0.0, 0.0, LOW]
    return build.observe(time, positions, build.hanging_chain(len(positions), 0.3), GROUND)


def intent(time, follows=True, command=(0.0, 0.0, 0.0), reference=(0.0, 1.5, 0.0), **others):
    zero = (0.0, 0.0, 0.0)
    values = dict(time=time, follows=follows, command=command, reference=reference)
    more = dict(hears=True, coordinated=True, acceleration=zero, departure=zero)
    return AssistantIntent(**{**values, **more, **others})


@pytest.mark.parametrize("heard", [always, lambda _name, cycle: cycle % 15 == 0])
def test_apart_they_decide_what_one_program_decides(heard):
    """Also if most of the intents are lost: on the same states all come to the same solution."""
    together, apart = dive(CENTRALISED), dive(COORDINATED, heard=heard)
    np.testing.assert_array_equal(apart.positions, together.positions)
    np.testing.assert_array_equal(apart.all("command"), together.all("command"))
    assert apart.all("coordinated").all()


def test_who_hears_nothing_takes_shares():
    """After the timeout; in lock-step, where nothing is lost, they stay together."""
    apart = dive(COORDINATED, heard=never)
    timeout = round(0.2 / DT)
    assert apart.all("coordinated")[:timeout].all()
    assert not apart.all("coordinated")[timeout + 1 :].any()
    assert apart.h("collision").min() >= -1e-3
    assert set(apart.all("status").flat) <= {Status.NOMINAL, Status.CONSTRAINED}
    shares = dive(DECENTRALISED)
    np.testing.assert_allclose(apart.positions[-1], shares.positions[-1], atol=0.02)
    trusting = dive(COORDINATED, heard=never, trusting=True)
    np.testing.assert_array_equal(trusting.positions, dive(CENTRALISED).positions)


def test_limits_hold_while_intents_come_and_go():
    random = np.random.default_rng(0)
    silent = {
        name: random.random(12) < 0.5 for name in ("assistant_1", "assistant_2", "assistant_3")
    }
    apart = dive(COORDINATED, heard=lambda name, cycle: not silent[name][cycle // 100])
    changes = np.diff(apart.all("coordinated").astype(int), axis=0)
    assert np.count_nonzero(changes) > 3
    assert apart.h("collision").min() >= -1e-3
    assert apart.h("overstretch").min() >= -1e-3
    steps = np.diff(apart.all("command"), axis=0)
    assert np.abs(steps).max() <= 0.01 + 1e-9  # 1 m/s^2


def test_one_that_stands_still_is_made_up_for(scenario):
    controller = TeamController(scenario, ("assistant_1",))
    assert controller.names == ("assistant_1",) and controller.others == ("assistant_2",)
    team = TeamController(scenario, ("assistant_1", "assistant_2"))
    for each in (controller, team):
        each.update(low_state(scenario, 0.0))
    told = team.intent("assistant_2")
    team.set_enabled("assistant_2", False)
    controller.hear(
        "assistant_2",
        intent(0.0, follows=False, command=told.command, acceleration=told.acceleration),
    )
    for cycle in range(1, 4):
        state = low_state(scenario, cycle * DT)
        decision = controller.update(state)["assistant_1"]
        assert decision.coordinated
        expected = team.update(state)["assistant_1"].command
        np.testing.assert_array_equal(decision.command, expected)


def test_one_that_does_something_else_is_left_to_its_share(scenario):
    controllers = [TeamController(scenario, (name,)) for name in ("assistant_1", "assistant_2")]
    told_wrong = 3
    coordinated = []
    for cycle in range(40):
        state = low_state(scenario, cycle * DT)
        decisions = [each.update(state) for each in controllers]
        coordinated.append(
            [decisions[0]["assistant_1"].coordinated, decisions[1]["assistant_2"].coordinated]
        )
        told = controllers[1].intent("assistant_2")
        if cycle == told_wrong:
            told = intent(cycle * DT, command=(0.1, 0.0, -0.1))
        controllers[0].hear("assistant_2", told)
        controllers[1].hear("assistant_1", controllers[0].intent("assistant_1"))
    first, second = np.array(coordinated).T
    # The first one at once, the second one when it is told of it; both come back after the timeout.
    assert first[: told_wrong + 1].all() and not first[told_wrong + 1 : told_wrong + 20].any()
    assert second[: told_wrong + 2].all() and not second[told_wrong + 2 : told_wrong + 20].any()
    assert first[-5:].all() and second[-5:].all()


def test_a_place_that_another_one_takes_is_learnt(scenario):
    """What it wants then is known: nothing is left of the error that would drive it away."""
    far = np.array([[0.0, 0.0, 5.0], [0.0, 0.0, 5.0], [0.0, 0.3, 5.0]])
    positions = np.array([agent.start for agent in scenario.agents]) + far
    state = [
        build.observe(k * DT, positions, build.hanging_chain(3, 0.3), GROUND) for k in range(3)
    ]
    controllers = [TeamController(scenario, (name,)) for name in ("assistant_1", "assistant_2")]
    for controller in controllers:
        controller.update(state[0])
    controllers[1].take_reference("assistant_2", state[0])
    told = controllers[1].intent("assistant_2")
    np.testing.assert_allclose(told.reference, (0.0, 1.8, 0.0), atol=1e-12)
    controllers[0].hear("assistant_2", told)
    for observation in state[1:]:
        decisions = [each.update(observation) for each in controllers]
        controllers[0].hear("assistant_2", controllers[1].intent("assistant_2"))
    assert decisions[0]["assistant_1"].coordinated


def test_who_waits_says_so(scenario):
    controller = TeamController(scenario, ("assistant_2",))
    controller.update(low_state(scenario, 0.0))
    assert controller.intent("assistant_2").follows
    controller.wait("the state is lost")
    assert not controller.intent("assistant_2").follows
    controller.update(low_state(scenario, DT))
    assert controller.intent("assistant_2").follows


@pytest.mark.parametrize("field", ["time", "command", "reference", "acceleration", "departure"])
def test_intents_that_are_not_finite_are_refused(field):
    value = np.nan if field == "time" else (0.0, np.inf, 0.0)
    with pytest.raises(ValueError, match="not finite"):
        intent(**{"time": 0.0, field: value})


def test_what_is_heard_late_or_twice_changes_nothing(scenario):
    heard, plain = (TeamController(scenario, ("assistant_1",)) for _ in range(2))
    other = TeamController(scenario, ("assistant_2",))
    first = None
    for cycle in range(5):
        state = low_state(scenario, cycle * DT)
        other.update(state)
        told = other.intent("assistant_2")
        decisions = [each.update(state)["assistant_1"] for each in (heard, plain)]
        np.testing.assert_array_equal(decisions[0].command, decisions[1].command)
        heard.hear("assistant_2", told)
        heard.hear("assistant_2", told)
        first = first or told
        heard.hear("assistant_2", first)
