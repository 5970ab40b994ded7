"""The compiled simulation as Python sees it; its physics is tested in C++."""

import threading
import time

import numpy as np
import pytest

from deformable_manipulation import _pbd

SEGMENTS = 28
END = SEGMENTS - 1
GRAVITY = 9.81  # m/s^2
ROPE = {
    "length": 2.25,
    "radius": 0.0035,
    "density": 1792.89,
    "segments": SEGMENTS,
    "young_modulus": 3.0e7,
    "torsion_modulus": 1.0e7,
    "stretch": "zero",
    "damping": 10.0,
    "solver": "direct",
    "gravity": (0.0, 0.0, -GRAVITY),
}
ALONG_Y = (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))
UP = (0.0, 0.0, 0.05)


@pytest.fixture
def rope():
    """A rope held at both ends, 1.5 m apart, as it was laid out: neither settled nor at rest."""
    rod = _pbd.Rod(**ROPE, orientation=ALONG_Y)
    rod.hold(0, "clamped", (0.0, 0.0, 1.0), ALONG_Y)
    rod.hold(END, "pinned", (0.0, 1.5, 1.0), ALONG_Y)
    rod.lay_out()
    return rod


def make_simulation(perturbations=((1, UP),), steps_per_cycle=1):
    agents = [
        ("leader", 0, "clamped", (0.0, 0.0, 1.0), ALONG_Y),
        ("assistant", END, "clamped", (0.0, 1.5, 1.0), ALONG_Y),
    ]
    return _pbd.Simulation(
        _pbd.Rod(**ROPE, orientation=ALONG_Y), agents, list(perturbations), 0.01, 2, steps_per_cycle
    )


def test_threads_do_not_change_the_result():
    rods = [_pbd.Rod(**ROPE, orientation=ALONG_Y, threads=threads) for threads in (1, 2)]
    for rod in rods:
        rod.hold(0)
        for i in range(12):
            rod.add_copy(0, (0.0, 0.0, 0.01 * (i + 1)))
        rod.step(0.1, 40)
    assert np.array_equal(rods[0].points(), rods[1].points())
    with pytest.raises(_pbd.ParameterError, match="threads: 0 - must be a whole number"):
        _pbd.Rod(**ROPE, threads=0)


@pytest.mark.parametrize(
    "step, key",
    [((0.0, 1), "time_step"), ((np.nan, 1), "time_step"), ((0.01, 0), "substeps")],
)
def test_steps_that_cannot_be(rope, step, key):
    with pytest.raises(_pbd.ParameterError, match=key + ": .* - must be"):
        rope.step(*step)


@pytest.fixture
def simulation():
    return make_simulation()


def test_arrays_of_a_body(rope):
    rope.add_copy(END, UP)
    for array, shape in (
        (rope.points(), (2, SEGMENTS + 1, 3)),
        (rope.positions(), (SEGMENTS, 3)),
        (rope.positions(1), (SEGMENTS, 3)),
        (rope.velocities(), (SEGMENTS, 3)),
        (rope.orientations(), (SEGMENTS, 4)),
    ):
        assert (array.shape, array.dtype) == (shape, np.float64)
        assert array.flags.c_contiguous
    np.testing.assert_allclose(np.linalg.norm(rope.orientations(), axis=1), 1.0)
    assert (rope.copy_count, rope.particle_count, rope.point_count) == (2, SEGMENTS, SEGMENTS + 1)


def test_arrays_of_a_simulation(simulation):
    for array, shape, dtype in (
        (simulation.points(), (2, SEGMENTS + 1, 3), np.float64),
        (simulation.positions(), (2, 3), np.float64),
        (simulation.orientations(), (2, 4), np.float64),
        (simulation.velocities(), (2, 3), np.float64),
        (simulation.displacements(), (2, 3), np.float64),
        (simulation.displaced_agents(), (2,), np.int32),
        (simulation.ready(), (2,), np.bool_),
    ):
        assert (array.shape, array.dtype) == (shape, dtype)
    assert simulation.displaced_agents().tolist() == [-1, 1]
    assert simulation.particles() == [0, END]


def test_segments_are_between_their_ends(rope):
    rope.settle()
    ends = rope.points()[0]
    # Two segments meet within what a step leaves open, and the point lies between them.
    np.testing.assert_allclose(rope.positions(), 0.5 * (ends[1:] + ends[:-1]), atol=1e-5)


def test_arrays_are_the_caller_s_own(rope):
    before = rope.points()
    kept = before.copy()
    rope.step(0.01, 2)
    np.testing.assert_array_equal(before, kept)
    before[:] = np.nan
    assert np.isfinite(rope.points()).all()


@pytest.mark.parametrize("source", ["body", "simulation"])
def test_points_are_written_where_the_caller_wants(rope, simulation, source):
    owner = rope if source == "body" else simulation
    out = np.full(owner.points().shape, np.nan)
    assert owner.points(out=out) is out
    np.testing.assert_array_equal(out, owner.points())


@pytest.mark.parametrize(
    "change, error, message",
    [
        (lambda a: a[:, :-1].copy(), ValueError, r"wrong shape.*\[1, 29, 3\]"),
        (lambda a: a[0], ValueError, "wrong shape"),
        (lambda a: np.zeros((0,)), ValueError, "wrong shape"),
        (lambda a: a.astype(np.float32), TypeError, "float64"),
        (lambda a: np.asfortranarray(a), TypeError, "C-contiguous"),
        (lambda a: np.zeros((1, 29, 6))[..., ::2], TypeError, "C-contiguous"),
        (lambda a: a.tolist(), TypeError, "array"),
    ],
)
def test_an_array_that_does_not_fit_is_refused(rope, change, error, message):
    with pytest.raises(error, match=message):
        rope.points(out=change(rope.points()))


def test_a_read_only_array_is_refused(rope):
    out = rope.points()
    out.flags.writeable = False
    kept = out.copy()
    rope.step(0.01, 2)
    with pytest.raises(ValueError, match="writ"):
        rope.points(out=out)
    np.testing.assert_array_equal(out, kept)


def test_all_wrong_parameters_are_named_at_once():
    wrong = {**ROPE, "length": -1.0, "segments": 0, "young_modulus": float("nan")}
    with pytest.raises(_pbd.ParameterError) as error:
        _pbd.Rod(**wrong)
    assert isinstance(error.value, ValueError)
    problems = error.value.problems
    assert [key for key, _, _ in problems] == ["length", "segments", "young_modulus"]
    for key, value, allowed in problems:
        assert key in str(error.value) and value in str(error.value) and allowed


@pytest.mark.parametrize(
    "choice, allowed", [({"stretch": "much"}, "zero"), ({"solver": "magic"}, "gauss_seidel")]
)
def test_a_wrong_choice_names_the_right_ones(choice, allowed):
    with pytest.raises(_pbd.ParameterError, match=allowed) as error:
        _pbd.Rod(**{**ROPE, **choice})
    ((key, _, _),) = error.value.problems
    assert key == list(choice)[0]


@pytest.mark.parametrize(
    "wrong",
    [
        {"young_modulus": 3.0e10, "colour": 1.0},
        {"young_modulus": 3.0e10, "torsion_modulus": 0.0, "damping": -1.0},
    ],
)
def test_wrong_material_changes_nothing(rope, wrong):
    reference = rope.clone()
    with pytest.raises(_pbd.ParameterError) as error:
        rope.set_material(wrong)
    assert {key for key, _, _ in error.value.problems} == set(wrong) - {"young_modulus"}
    rope.step(0.01, 2)
    reference.step(0.01, 2)
    np.testing.assert_array_equal(rope.points(), reference.points())


def test_material_is_changed_while_running(rope):
    reference = rope.clone()
    rope.set_material({"young_modulus": 3.0e10})
    rope.step(0.01, 2)
    reference.step(0.01, 2)
    assert np.abs(rope.points() - reference.points()).max() > 1e-6


def test_a_state_that_breaks_down_is_reported(rope):
    rope.set_velocity(0, (1e300, 0.0, 0.0))
    with pytest.raises(_pbd.NonFiniteState, match="particle") as error:
        for _ in range(100):
            rope.step(1e10, 1)
    assert isinstance(error.value, RuntimeError)


def test_held_ends_carry_the_weight(rope):
    assert rope.settle(speed_tolerance=1e-6)
    forces = np.array([rope.wrench(0)[0], rope.wrench(END)[0]])
    volume = np.pi * ROPE["radius"] ** 2 * ROPE["length"]
    assert rope.mass == pytest.approx(volume * ROPE["density"], rel=1e-3)
    # A held segment weighs on its agent, too; gravity acts on it as on all others.
    np.testing.assert_allclose(
        forces.sum(axis=0), [0.0, 0.0, -rope.mass * GRAVITY], atol=1e-3 * rope.mass * GRAVITY
    )
    assert forces[0, 1] > 0.0 > forces[1, 1]  # both are pulled inwards


def test_a_particle_is_released_and_held_again(rope):
    rope.release(END)
    rope.step(0.01, 2)
    lower = rope.positions()[END, 2]
    for _ in range(20):
        rope.step(0.01, 2)
    assert rope.positions()[END, 2] < lower - 0.05
    with pytest.raises(ValueError):
        rope.release(END)
    rope.hold(END)
    there = rope.positions()[END]
    for _ in range(20):
        rope.step(0.01, 2)
    np.testing.assert_allclose(rope.positions()[END], there, atol=1e-12)
    with pytest.raises(ValueError):
        rope.hold(END)


def test_wrong_holds_are_refused(rope):
    for particle in (-1, SEGMENTS):
        with pytest.raises(IndexError):
            rope.hold(particle)
    with pytest.raises(_pbd.ParameterError, match="clamped or pinned"):
        rope.hold(3, "glued")
    with pytest.raises(ValueError, match="both"):
        rope.hold(3, "clamped", (0.0, 0.0, 0.0))
    with pytest.raises(ValueError):
        rope.hold(3, "clamped", (0.0, 0.0, np.nan), ALONG_Y)
    with pytest.raises(ValueError):
        rope.set_velocity(3, (0.0, 0.0, 0.0))  # not held


def test_a_held_particle_moves_as_told(rope):
    before = rope.positions()[0]
    rope.set_velocity(0, (0.0, -0.1, 0.2))
    rope.step(0.01, 2)
    np.testing.assert_allclose(rope.positions()[0] - before, [0.0, -0.001, 0.002], atol=1e-12)
    rope.set_pose(0, (0.1, 0.0, 1.1), ALONG_Y)
    rope.set_velocity(0, (0.0, 0.0, 0.0))
    rope.step(0.01, 2)
    np.testing.assert_allclose(rope.positions()[0], [0.1, 0.0, 1.1], atol=1e-12)


def test_copies_come_move_and_go(rope):
    rope.settle()
    first, second = rope.add_copy(END, UP), rope.add_copy(0, (-0.03, 0.0, 0.0))
    assert rope.copy_ids == [first, second]
    np.testing.assert_array_equal(rope.points()[1], rope.points()[0])
    for _ in range(300):
        rope.step(0.01, 2)
    np.testing.assert_allclose(rope.positions(1)[END] - rope.positions()[END], UP, atol=1e-9)
    np.testing.assert_allclose(rope.positions(2)[0] - rope.positions()[0], [-0.03, 0, 0], atol=1e-9)
    moved = rope.points()[2]
    rope.remove_copy(first)
    assert rope.copy_ids == [second]
    np.testing.assert_array_equal(rope.points()[1], moved)
    with pytest.raises(ValueError):
        rope.remove_copy(first)
    with pytest.raises(IndexError, match="copies 0 to 1"):
        rope.positions(2)
    for displacement in ((0.0, 0.0, 0.0), (0.0, np.inf, 0.0), (0.0, 99.0, 0.0)):
        with pytest.raises(ValueError):
            rope.add_copy(END, displacement)


def test_a_clone_is_independent(rope):
    rope.add_copy(END, UP)
    clone = rope.clone()
    before = rope.points()
    for _ in range(5):
        clone.step(0.01, 2)
    np.testing.assert_array_equal(rope.points(), before)
    for _ in range(5):
        rope.step(0.01, 2)
    np.testing.assert_array_equal(rope.points(), clone.points())


def test_a_simulation_takes_a_copy_of_the_body():
    rod = _pbd.Rod(**ROPE, orientation=ALONG_Y)
    before = rod.points()
    agents = [("leader", 0, "clamped", (0.0, 0.0, 1.0), ALONG_Y)]
    _pbd.Simulation(rod, agents, [], 0.01, 2).advance()
    np.testing.assert_array_equal(rod.points(), before)


def test_a_simulation_s_body_outlives_it():
    body = make_simulation().body
    assert np.isfinite(body.points()).all()


def test_cycles_commands_and_reset():
    simulation = make_simulation(steps_per_cycle=2)
    assert simulation.rest == "stable"
    start = simulation.points()
    simulation.set_command(1, (0.0, 0.0, 0.1))
    np.testing.assert_array_equal(simulation.velocities(), 0.0)
    simulation.advance()
    assert (simulation.cycle, simulation.reset_count) == (1, 0)
    assert simulation.time == pytest.approx(0.02)
    np.testing.assert_allclose(simulation.velocities()[1], [0.0, 0.0, 0.1])
    np.testing.assert_allclose(simulation.positions()[1], [0.0, 1.5, 1.002], atol=1e-12)
    simulation.reset()
    assert (simulation.cycle, simulation.reset_count, simulation.time) == (0, 1, 0.0)
    np.testing.assert_array_equal(simulation.points(), start)
    with pytest.raises(IndexError):
        simulation.set_command(2, (0.0, 0.0, 0.0))
    with pytest.raises(ValueError):
        simulation.set_command(1, (np.nan, 0.0, 0.0))


def test_perturbations_of_a_simulation(simulation):
    simulation.add_perturbation(0, (0.02, 0.0, 0.0))
    assert simulation.displaced_agents().tolist() == [-1, 1, 0]
    assert simulation.ready().tolist() == [True, True, False]
    for _ in range(500):
        simulation.advance()
    assert simulation.ready().all()
    np.testing.assert_allclose(
        simulation.displacements(), [(0.0, 0.0, 0.0), UP, (0.02, 0.0, 0.0)], atol=1e-12
    )
    simulation.clear_perturbations(1)
    assert simulation.displaced_agents().tolist() == [-1, 0]
    assert simulation.points().shape[0] == 2


def test_a_simulation_takes_only_what_makes_sense():
    rod = _pbd.Rod(**ROPE)
    good = ("leader", 0, "clamped", (0.0, 0.0, 1.0), ALONG_Y)
    for agents in ([good, ("twice", 0, "clamped", (0.0, 1.0, 1.0), ALONG_Y)], []):
        with pytest.raises((ValueError, RuntimeError)):
            _pbd.Simulation(rod, agents, [], 0.01, 2)
    with pytest.raises(_pbd.ParameterError) as error:
        _pbd.Simulation(rod, [good], [], -0.01, 0)
    assert len(error.value.problems) == 2


def test_other_threads_run_while_it_advances():
    rope = _pbd.Rod(**{**ROPE, "segments": 400})
    rope.hold(0)
    span = []

    def advance():
        span.append(time.monotonic())
        rope.step(1.0, 1000)
        span.append(time.monotonic())

    thread = threading.Thread(target=advance)
    thread.start()
    ticks = []
    while len(span) < 2:
        ticks.append(time.monotonic())
    thread.join()
    # Around its start and end another thread may run anyway, but not in the midst of it.
    begin, end = np.interp([0.25, 0.75], [0.0, 1.0], span)
    assert any(begin < tick < end for tick in ticks)
