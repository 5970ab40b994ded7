import dataclasses

import control_builders as build
import numpy as np
import pytest
from mesh_reference import changed

from deformable_manipulation.control.status import Status
from deformable_manipulation.scenario.spec import CollisionSpec, OverstretchSpec, ProximitySpec

DT = 0.01
GROUND = build.HalfSpace((0.0, 0.0, 1.0), 0.0)
FAR = build.HalfSpace((0.0, 0.0, 1.0), -5.0)


def starts(scenario):
    return np.array([agent.start for agent in scenario.agents])


@pytest.fixture
def scenario():
    return build.scenario()


def observed(scenario, time=0.0, positions=None, obstacle=FAR, **settings):
    positions = starts(scenario) if positions is None else positions
    body = build.hanging_chain(len(positions), sag=0.3)
    return build.observe(time, positions, body, obstacle, **settings)


def test_rests_on_its_target(scenario):
    decision = build.Alone(scenario).update(observed(scenario))
    assert decision.status == Status.NOMINAL
    np.testing.assert_array_equal(decision.command, 0.0)
    np.testing.assert_array_equal(decision.target, [0.0, 1.5, 1.0])
    assert decision.error_norm == 0.0
    assert decision.h["overstretch"] == pytest.approx(0.5)
    assert decision.h["proximity"] == pytest.approx(1.3)
    assert decision.distance == pytest.approx(5.7)
    assert decision.h["collision"] == pytest.approx(5.65)
    np.testing.assert_allclose(decision.jacobian, [0.0, 0.0, 0.5], atol=1e-12)


def test_returns_to_its_target_within_its_limits(scenario):
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    controller = build.Alone(scenario)
    first = controller.update(observed(scenario, 0.0, positions))
    np.testing.assert_allclose(first.nominal, [0.0, 0.5, 0.0], atol=1e-12)
    np.testing.assert_allclose(first.command, [0.0, 0.01, 0.0], atol=1e-12)  # 1 m/s^2
    for k in range(1, 40):
        last = controller.update(observed(scenario, k * DT, positions))
    np.testing.assert_allclose(last.command, [0.0, 0.15, 0.0], atol=1e-12)
    assert last.status == Status.CONSTRAINED


def test_the_nominal_law_looks_ahead_to_when_the_command_acts(scenario):
    """Own point by the command that acts until then, leader by its measured velocity."""
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    controller = build.Alone(scenario)
    first = controller.update(observed(scenario, 0.0, positions))
    leader_velocity = np.array([0.0, 0.03, -0.05])
    moved = positions + DT * np.array([leader_velocity, np.zeros(3)])
    second = controller.update(observed(scenario, DT, moved))
    error = second.error + DT * (leader_velocity - first.command)
    np.testing.assert_allclose(second.nominal, error + leader_velocity, atol=1e-12)


def test_takes_the_present_relative_position_as_reference(scenario):
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.1]]
    controller = build.Alone(scenario)
    controller.take_reference(observed(scenario, 0.0, positions))
    decision = controller.update(observed(scenario, 0.0, positions))
    np.testing.assert_array_equal(decision.target, positions[1])
    np.testing.assert_array_equal(decision.command, 0.0)
    controller.team.reset()
    again = controller.update(observed(scenario, 0.0, positions))
    np.testing.assert_array_equal(again.target, [0.0, 1.5, 1.0])


def test_refuses_a_reference_that_is_not_finite(scenario):
    controller = build.Alone(scenario)
    with pytest.raises(ValueError, match="positions"):
        controller.take_reference(observed(scenario, positions=np.full((2, 3), np.nan)))


def test_disabled_sends_zero_and_still_measures(scenario):
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    controller = build.Alone(scenario)
    controller.update(observed(scenario, 0.0, positions))
    controller.enable(False)
    decision = controller.update(observed(scenario, 0.0, positions))
    assert decision.status == Status.DISABLED and not decision.enabled
    np.testing.assert_array_equal(decision.command, 0.0)
    assert decision.error_norm == pytest.approx(0.5)
    controller.enable(True)
    again = controller.update(observed(scenario, DT, positions))
    np.testing.assert_allclose(again.command, [0.0, 0.01, 0.0], atol=1e-12)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("safety", [True, False])
@pytest.mark.parametrize(
    "field",
    [
        "time",
        "lateness",
        "positions",
        "points",
        "displacements",
        "distances.minimum",
        "distances.distance",
        "distances.normal",
        "distances.weights",
        "distances.obstacle_velocity",
    ],
)
def test_waits_for_input_that_is_finite_and_names_the_field(scenario, field, value, safety):
    controller = build.Alone(scenario, safety=safety)
    observation = broken(observed(scenario), field, value)
    decision = controller.update(observation)
    assert decision.status == Status.WAITING
    assert field in decision.text
    np.testing.assert_array_equal(decision.command, 0.0)
    after = controller.update(observed(scenario, DT))
    assert after.status != Status.WAITING and np.isfinite(after.command).all()


def broken(observation, field, value):
    owner, _, name = field.rpartition(".")
    part = observation.distances if owner else observation
    if name in ("time", "lateness"):
        return dataclasses.replace(observation, **{name: value})
    array = getattr(part, name).astype(float)
    array.flat[-1] = value
    if not owner:
        return dataclasses.replace(observation, **{name: array})
    return dataclasses.replace(observation, distances=changed(part, **{name: array}))


@pytest.mark.parametrize(
    "field, value",
    [
        ("positions", np.zeros((3, 3))),
        ("points", np.zeros((0, 2, 3))),
        ("ready", np.ones(2)),
        ("displaced_agents", np.full(4, 7)),
    ],
)
def test_waits_for_input_of_the_right_shape(scenario, field, value):
    observation = dataclasses.replace(observed(scenario), **{field: value})
    decision = build.Alone(scenario).update(observation)
    assert decision.status == Status.WAITING and field in decision.text


@pytest.mark.parametrize(
    "field, value",
    [
        ("time", None),
        ("time", "0.1"),
        ("time", np.zeros(2)),
        ("positions", None),
        ("positions", [[0.0, 0.0, 1.0], [0.0, 1.5, 1.0]]),
        ("points", "points"),
        ("displacements", np.full((7, 3), "0.1")),
        ("displacements", np.full((7, 3), None)),
        ("displaced_agents", np.zeros(7)),
        ("ready", np.ones(7)),
        ("distances", None),
    ],
)
def test_waits_for_input_of_the_right_type(scenario, field, value):
    observation = dataclasses.replace(observed(scenario), **{field: value})
    controller = build.Alone(scenario)
    decision = controller.update(observation)
    assert decision.status == Status.WAITING and field in decision.text
    np.testing.assert_array_equal(decision.command, 0.0)
    with pytest.raises(ValueError, match=field):
        controller.take_reference(observation)


@pytest.mark.parametrize("observation", [None, 3, {"time": 0.0}])
def test_waits_for_an_observation(scenario, observation):
    decision = build.Alone(scenario).update(observation)
    assert decision.status == Status.WAITING
    assert "not an Observation" in decision.text


@pytest.mark.parametrize("safety", [True, False])
def test_enormous_numbers_never_give_a_command_that_is_not_finite(scenario, safety):
    controller = build.Alone(scenario, safety=safety)
    with np.errstate(all="ignore"):
        for k, size in enumerate((0.0, 1e300, -1e308, 1e308, 1e-308)):
            decision = controller.update(observed(scenario, k * DT, starts(scenario) + size))
            assert np.isfinite(decision.command).all()
            assert (np.abs(decision.command) <= 0.15).all()


def test_waits_for_its_copies(scenario):
    controller = build.Alone(scenario)
    moving = np.array([True, False, True, True])
    decision = controller.update(observed(scenario, obstacle=GROUND, ready=moving))
    assert decision.status == Status.WAITING and "assistant_1" in decision.text
    ready = controller.update(observed(scenario, DT, obstacle=GROUND))
    assert ready.status == Status.NOMINAL
    held = controller.update(observed(scenario, 2 * DT, obstacle=GROUND, ready=moving))
    assert held.status == Status.NOMINAL
    np.testing.assert_allclose(held.jacobian, ready.jacobian)


def test_needs_no_copies_without_obstacles(scenario):
    none = (np.array([-1]), np.zeros((1, 3)))
    decision = build.Alone(scenario).update(observed(scenario, obstacle=None, copies=none))
    assert decision.status == Status.NOMINAL
    assert decision.distance == np.inf and decision.rows == 2


def test_a_state_is_answered_once(scenario):
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    controller = build.Alone(scenario)
    controller.update(observed(scenario, 0.0, positions))
    second = controller.update(observed(scenario, DT, positions))
    assert controller.update(observed(scenario, DT, positions)) is second
    assert controller.update(observed(scenario, 0.0, positions)) is second
    third = controller.update(observed(scenario, 2 * DT, positions))
    np.testing.assert_allclose(third.command, [0.0, 0.03, 0.0], atol=1e-12)


def test_time_set_back_starts_afresh(scenario):
    controller = build.Alone(scenario)
    controller.update(observed(scenario, 10.0))
    moved = starts(scenario) + [1.0, 0.0, 0.0]
    decision = controller.update(observed(scenario, 0.0, moved))
    assert decision.status == Status.NOMINAL
    np.testing.assert_array_equal(decision.nominal, 0.0)  # no velocity out of the jump


def test_the_reference_outlives_time_set_back(scenario):
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    controller = build.Alone(scenario)
    controller.take_reference(observed(scenario, 0.0, positions))
    controller.update(observed(scenario, 10.0, positions))
    decision = controller.update(observed(scenario, 0.0, positions))
    np.testing.assert_array_equal(decision.target, positions[1])


def test_without_safety_the_nominal_velocity_passes_within_its_limits(scenario):
    positions = starts(scenario) * [1.0, 1.0, 0.1]  # the object is in the ground
    controller = build.Alone(scenario, safety=False)
    decision = controller.update(observed(scenario, 0.0, positions, GROUND))
    assert decision.status == Status.UNSAFE_FILTER_OFF
    assert decision.h["collision"] < 0.0
    np.testing.assert_array_equal(decision.command, 0.0)
    guarded = build.Alone(scenario)
    lifted = guarded.update(observed(scenario, 0.0, positions, GROUND))
    assert lifted.command[2] == pytest.approx(0.01)
    assert lifted.status == Status.RELAXED and "collision by" in lifted.text


def test_the_single_row_of_the_paper():
    scenario = build.scenario(
        formulation="paper", collision=CollisionSpec(offset=0.05, gradient="minimum")
    )
    observation = observed(scenario, obstacle=GROUND)
    decision = build.Alone(scenario).update(observation)
    assert decision.rows == 3
    copies, minimum = observation.displaced_agents == 1, observation.distances.minimum
    np.testing.assert_allclose(decision.jacobian, (minimum[copies] - minimum[0]) / 0.1)


def papers(**settings):
    collision = CollisionSpec(offset=0.05, margin=0.0, gradient="minimum")
    return build.scenario(
        formulation="paper",
        differences="forward",
        feedforward=False,
        collision=collision,
        overstretch=OverstretchSpec(2.0, margin=0.0),
        **settings,
    )


def test_the_papers_nominal_law_and_bound():
    """Eq. 2 and the velocity bound alone: no prediction, no leader's velocity, no acceleration."""
    scenario = papers()
    controller = build.Alone(scenario)
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    first = controller.update(observed(scenario, 0.0, positions))
    np.testing.assert_allclose(first.nominal, [0.0, 0.5, 0.0], atol=1e-12)
    np.testing.assert_allclose(first.command, [0.0, 0.15, 0.0], atol=1e-12)
    moved = positions + [[0.0, 0.0, -0.001], [0.0, 0.0, 0.0]]
    second = controller.update(observed(scenario, DT, moved))
    np.testing.assert_allclose(second.nominal, second.error, atol=1e-12)


def test_the_paper_has_no_answer_where_limits_contradict():
    scenario = papers()
    positions = starts(scenario) * [1.0, 1.0, 0.0]  # on the ground, the object in it
    decision = build.Alone(scenario).update(observed(scenario, 0.0, positions, GROUND))
    assert decision.status == Status.FAILED
    np.testing.assert_array_equal(decision.command, 0.0)


def test_the_users_priority_decides_which_limit_yields(scenario):
    """Too near to a wall behind the assistant, and too near to the leader in front of it."""
    wall = build.HalfSpace((0.0, -1.0, 0.0), -1.54)  # beyond y = 1.54
    settings = dict(proximity=ProximitySpec(1.53), max_acceleration=15.0)
    velocities = []
    for first, second in (("collision", "proximity"), ("proximity", "collision")):
        chosen = build.scenario(priority=(first, second, "overstretch"), **settings)
        controller = build.Alone(chosen)
        decision = controller.update(observed(chosen, obstacle=wall))
        assert decision.status == Status.RELAXED
        assert decision.slack[first] == 0.0 < decision.slack[second]
        velocities.append(decision.command[1])
    # alpha: 5 times 12 mm with the margin, and 2 times 30 mm.
    np.testing.assert_allclose(velocities, [-0.06, 0.06], atol=1e-6)


def test_unknown_agents_are_refused(scenario):
    for name in ("leader", "assistant_7"):
        with pytest.raises(ValueError, match=f"agent: '{name}'.*assistant_1"):
            build.Alone(scenario, name)


def test_statuses_are_those_of_the_message_and_have_a_sentence():
    assert [status.name for status in sorted(Status)] == [
        "NOMINAL",
        "CONSTRAINED",
        "RELAXED",
        "FAILED",
        "WAITING",
        "DISABLED",
        "UNSAFE_FILTER_OFF",
    ]
    assert len({status.sentence for status in Status}) == len(Status)


def test_goes_on_with_other_parameters_without_forgetting(scenario):
    """Command, measured velocities and reference stay; gains and limits are the new ones."""
    positions = starts(scenario) + [[0.0, 0.0, 0.0], [0.0, -0.5, 0.0]]
    controller = build.Alone(scenario)
    controller.take_reference(observed(scenario, 0.0, starts(scenario) + [[0, 0, 0], [0, 0.1, 0]]))
    for k in range(40):
        controller.update(observed(scenario, k * DT, positions))
    changed = dataclasses.replace(
        scenario,
        controller=dataclasses.replace(
            scenario.controller,
            gain=0.2,
            max_acceleration=0.5,
            collision=CollisionSpec(offset=0.5),
            overstretch=OverstretchSpec(max_distance=1.8),
            proximity=ProximitySpec(min_distance=0.3),
        ),
    )
    before = controller.update(observed(scenario, 0.4, positions))
    controller.team.set_parameters(changed)
    after = controller.update(observed(scenario, 0.41, positions))
    np.testing.assert_array_equal(after.target, before.target)
    np.testing.assert_allclose(after.command - before.command, [0.0, -0.005, 0.0], atol=1e-12)
    np.testing.assert_allclose(after.nominal, 0.2 * (after.error - DT * before.command), atol=1e-12)
    assert before.h["collision"] - after.h["collision"] == pytest.approx(0.45)
    assert before.h["overstretch"] - after.h["overstretch"] == pytest.approx(0.2)
    assert before.h["proximity"] - after.h["proximity"] == pytest.approx(0.1)
    controller.team.reset()
    again = controller.update(observed(scenario, 0.0, positions))
    np.testing.assert_array_equal(again.target, [0.0, 1.5, 1.0])
    assert again.h["proximity"] == after.h["proximity"]


def test_refuses_parameters_of_other_agents(scenario):
    controller = build.Alone(scenario)
    with pytest.raises(ValueError, match="other agents"):
        controller.team.set_parameters(build.scenario(assistants=2))


def commands_until_rest(controller, slow):
    """Commands (N, 3) of an assistant that moves, from one call of ``slow`` to the next."""
    commands = [slow(number) for number in range(100)]
    rest = next(number for number, command in enumerate(commands) if not command.any())
    assert not np.any(commands[rest:])
    return np.array(commands[: rest + 1])


def moving(**settings):
    """A controller whose assistant has come to full speed along z, and its next observations."""
    scenario = build.scenario(**settings)
    positions = np.array([agent.start for agent in scenario.agents])
    positions[0, 2] += 1.0  # the leader is far ahead
    body = build.hanging_chain(2, 0.5)

    def observation(cycle):
        return build.observe(0.01 * cycle, positions, body, None, cycle=cycle)

    controller = build.Alone(scenario)
    controller.take_reference(build.observe(0.0, positions - [[0, 0, 1.0], [0, 0, 0]], body, None))
    for cycle in range(1, 61):
        decision = controller.update(observation(cycle))
    assert decision.command[2] == pytest.approx(0.15)
    return controller, observation


@pytest.mark.parametrize("max_jerk, longest", [(1000.0, 16), (20.0, 22)])
@pytest.mark.parametrize("cause", ["disabled", "lost"])
def test_an_assistant_stops_within_its_limits(cause, max_jerk, longest):
    controller, observation = moving(max_jerk=max_jerk)
    if cause == "disabled":
        controller.enable(False)
        stopping = commands_until_rest(
            controller, lambda number: controller.update(observation(61 + number)).command
        )
    else:
        stopping = commands_until_rest(controller, lambda number: controller.wait("lost").command)
    velocities = np.vstack(([0.0, 0.0, 0.15], stopping))
    accelerations = np.vstack(([0.0, 0.0, 0.0], np.diff(velocities, axis=0) / 0.01))
    assert np.abs(accelerations).max() <= 1.0 + 1e-9
    assert np.abs(np.diff(accelerations, axis=0)).max() / 0.01 <= max_jerk + 1e-6
    assert (velocities[:, 2] >= -1e-9).all() and len(stopping) <= longest


def test_speeding_up_keeps_the_limit_of_jerk():
    controller, observation = moving()
    for max_jerk in (10.0, 100.0):
        controller, observation = build.Alone(build.scenario(max_jerk=max_jerk)), observation
        commands = np.array([controller.update(observation(c)).command for c in range(1, 80)])
        accelerations = np.diff(np.vstack((np.zeros(3), np.zeros(3), commands)), axis=0) / 0.01
        assert np.abs(np.diff(accelerations, axis=0)).max() / 0.01 <= max_jerk + 1e-6
        assert commands[-1, 2] == pytest.approx(0.15)
