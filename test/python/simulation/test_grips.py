"""Grips of several vertices: rigid motion, copies, reactions, and how the fabric follows turns."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from deformable_manipulation import _pbd
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.grip_points import held_points
from deformable_manipulation.simulation.factory import make_simulation
from deformable_manipulation.validation.fabric import FabricProperties, make_fabric, rectangle
from deformable_manipulation.validation.references.elastica import solve_cantilever
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy

NAME = "fabric_clamp_bars"
GRAVITY = np.array([0.0, 0.0, -9.81])


@pytest.fixture(scope="module")
def scenario():
    return load_scenario(NAME)


@pytest.fixture
def simulation(scenario):
    return make_simulation(scenario)


def bars(scenario):
    """Particles of each agent, that at the held point first."""
    return [list(agent.particles) for agent in scenario.agents]


def arms(scenario):
    """Places (7, 3) [m] of each bar's vertices around its held point, on the flat fabric."""
    flat = np.array(
        [scenario.object.particle_position(i) for i in range(scenario.object.particles)]
    )
    return [flat[bar] - flat[bar[0]] for bar in bars(scenario)]


def energy_of(fabric):
    return MeshEnergy(
        np.array(fabric.vertices),
        np.array(fabric.triangles),
        fabric.density,
        fabric.stretching_compliance,
        fabric.bending_compliance,
    )


def test_a_bar_starts_as_its_vertices_lie_on_the_flat_fabric(scenario, simulation):
    points = simulation.points()[0]
    for agent, bar, places in zip(scenario.agents, bars(scenario), arms(scenario)):
        np.testing.assert_allclose(points[bar], np.array(agent.start) + places, atol=1e-12)
        held = held_points(scenario.object, agent)
        np.testing.assert_allclose(points[list(held)], list(held.values()), atol=1e-12)


def test_a_bar_that_starts_turned_has_its_vertices_turned():
    turn = Rotation.from_rotvec([0.0, 0.3, 0.0])
    scenario = load_scenario(
        NAME, [("agents.assistant_1.orientation", str(turn.as_quat().tolist()))]
    )
    simulation = make_simulation(scenario, copies=False)
    agent, bar = scenario.agents[1], bars(scenario)[1]
    expected = np.array(agent.start) + turn.apply(arms(scenario)[1])
    np.testing.assert_allclose(simulation.points()[0, bar], expected, atol=1e-12)
    held = held_points(scenario.object, agent)
    np.testing.assert_allclose(list(held.values()), expected, atol=1e-12)


def test_a_bar_moves_as_one_rigid_piece_in_all_copies(scenario, simulation):
    linear, angular, cycles = np.array([0.05, 0.02, 0.04]), np.array([0.2, -0.3, 0.4]), 100
    simulation.set_command(1, linear, angular)
    for _ in range(cycles):
        simulation.advance()
    time = cycles * scenario.cycle_time
    turned = Rotation.from_rotvec(time * angular).apply(arms(scenario)[1])
    here = np.array(scenario.agents[1].start) + time * linear
    np.testing.assert_allclose(simulation.positions()[1], here, atol=1e-12)
    points = simulation.points()
    displaced, displacements = simulation.displaced_agents(), simulation.displacements()
    assert np.abs(displacements).max() == pytest.approx(0.1)
    for copy, (agent, displacement) in enumerate(zip(displaced, displacements)):
        shift = displacement if agent == 1 else 0.0
        np.testing.assert_allclose(
            points[copy, bars(scenario)[1]], here + turned + shift, atol=1e-12
        )


def test_reactions_carry_the_weight_and_its_moment(scenario, simulation):
    masses = scenario.object.masses()
    points = simulation.points()[0]
    simulation.advance()
    wrenches = [simulation.wrench(agent) for agent in range(2)]
    force = sum(force for force, _ in wrenches)
    weight = masses.sum() * GRAVITY
    np.testing.assert_allclose(force, weight, atol=2e-3 * np.abs(weight).max())
    moment = sum(
        torque + np.cross(position, force)
        for position, (force, torque) in zip(simulation.positions(), wrenches)
    )
    exact = np.cross(points, masses[:, None] * GRAVITY).sum(axis=0)
    np.testing.assert_allclose(moment, exact, atol=2e-3 * np.abs(exact).max())
    torques = np.array([torque for _, torque in wrenches])
    assert np.abs(torques[:, 0]).max() < 1e-9  # its own axis is no arm


def test_the_response_is_the_derivative_of_the_meshs_equilibrium(scenario):
    """By the points of the bars, and by turns about them: the sum over their vertices."""
    simulation = make_simulation(scenario, copies=False)
    response, turning = simulation.response(), simulation.turning_response()
    points = simulation.points()[0]
    for agent, bar in enumerate(bars(scenario)):
        held = [particle for each in bars(scenario) for particle in each]
        exact = energy_of(scenario.object).response(points, held)
        of_bar = exact[[held.index(particle) for particle in bar]]
        np.testing.assert_allclose(response[agent], of_bar.sum(axis=0), atol=1e-9)
        places = points[bar] - points[bar[0]]
        turned = np.array([np.cross(np.eye(3), place).T for place in places])  # [V, 3, axis]
        exact_turning = np.einsum("vpij,vjk->pik", of_bar, turned)
        np.testing.assert_allclose(turning[agent], exact_turning, atol=1e-9)
    np.testing.assert_allclose(response.sum(axis=0), np.tile(np.eye(3), (91, 1, 1)), atol=1e-9)


def test_the_wrenches_change_as_the_forces_of_the_mesh_do(scenario):
    """By moves and turns of both bars, from the second derivatives of the mesh's energy."""
    simulation = make_simulation(scenario, copies=False)
    response, turning = simulation.response(), simulation.turning_response()
    found = simulation.wrench_response()
    points, energy = simulation.points()[0], energy_of(scenario.object)
    motions = np.concatenate((response, turning), axis=3).transpose(0, 3, 1, 2)  # [A, 6, P, 3]
    hessian = energy.hessian(points, convex=False)
    forces = -energy.gradient(points)
    for by in range(2):
        for axis in range(6):
            motion = motions[by, axis]
            change = -(hessian @ motion.ravel()).reshape(-1, 3)
            for of, bar in enumerate(bars(scenario)):
                places, swings = points[bar] - points[bar[0]], motion[bar] - motion[bar[0]]
                torque = np.cross(places, change[bar]) + np.cross(swings, forces[bar])
                expected = np.concatenate((change[bar].sum(axis=0), torque.sum(axis=0)))
                # The forces of the simulation are those of its last substep.
                np.testing.assert_allclose(found[of, :, by, axis], expected, rtol=1e-3, atol=0.02)
    assert np.abs(found).max() > 10.0
    np.testing.assert_allclose(found[:, :, :, :3].sum(axis=2), 0.0, atol=1e-6)


def test_derivatives_are_not_told_where_there_is_no_response(scenario):
    simulation = make_simulation(scenario, copies=False)
    for agent in (None, 1, 0):
        if agent is not None:
            simulation.release(agent)
            assert isinstance(simulation.response(), str)
        assert simulation.turning_response() is None
        assert simulation.wrench_response() is None


def test_the_fabric_follows_a_turn_as_the_response_says(scenario):
    """Turned slowly by a small angle, and left to rest."""
    simulation = make_simulation(scenario, copies=False)
    before, turning = simulation.points()[0], None
    simulation.response()
    turning = simulation.turning_response()[1]
    turn = np.array([0.0, 0.03, 0.02])
    simulation.set_command(1, np.zeros(3), turn)
    for _ in range(100):
        simulation.advance()
    simulation.set_command(1, np.zeros(3), np.zeros(3))
    for _ in range(500):
        simulation.advance()
    moved = simulation.points()[0] - before
    expected = turning @ turn
    assert np.abs(expected).max() > 0.01
    np.testing.assert_allclose(moved, expected, atol=0.05 * np.abs(expected).max())


def test_a_grip_lets_all_its_vertices_go_and_holds_them_again(scenario, simulation):
    bar = bars(scenario)[1]
    assert len(simulation.displaced_agents()) == 7
    simulation.release(1)
    assert simulation.particles() == [3, -1]
    assert len(simulation.displaced_agents()) == 1
    before = simulation.points()[0, bar]
    for _ in range(5):  # it falls for a moment
        simulation.advance()
    fallen = simulation.points()[0, bar]
    assert (fallen[:, 2] < before[:, 2] - 0.005).all()
    simulation.hold(1, bar[0], "clamped", bar[1:])
    assert simulation.particles() == [3, bar[0]]
    assert len(simulation.displaced_agents()) == 7
    here = simulation.points()[0, bar]
    simulation.set_command(1, np.zeros(3), np.array([0.0, 0.0, 0.5]))
    for _ in range(20):
        simulation.advance()
    turn = Rotation.from_rotvec([0.0, 0.0, 0.1])
    np.testing.assert_allclose(
        simulation.points()[0, bar], here[0] + turn.apply(here - here[0]), atol=1e-12
    )


@pytest.mark.parametrize(
    "particle, further, words",
    [
        (87, [86, 86], "particle 86 is given twice"),
        (87, [87], "particle 87 is given twice"),
        (87, [91], "there are particles 0 to 90"),
        (87, [40], "m off its place in the grip"),
    ],
)
def test_grips_that_cannot_be_are_refused(scenario, simulation, particle, further, words):
    simulation.release(1)
    with pytest.raises((ValueError, IndexError, RuntimeError), match=words):
        simulation.hold(1, particle, "clamped", further)
    assert simulation.particles() == [3, -1]


@pytest.mark.parametrize(
    "hold, further, words",
    [
        ("pinned", [86], "clamped: several particles"),
        ("clamped", [91], "a particle of the object, 0 to 90"),
        ("clamped", [3], "a particle that no agent holds yet"),
        ("clamped", [87], "a particle that no agent holds yet"),
    ],
)
def test_agents_that_cannot_hold_so_are_refused(scenario, hold, further, words):
    level = (0.0, 0.0, 0.0, 1.0)
    agents = [
        ("leader", 3, "clamped", (0.0, 0.0, 1.2), level),
        ("assistant_1", 87, hold, (0.0, 1.85, 1.2), level, further),
    ]
    body = make_body(scenario.object)
    with pytest.raises(_pbd.ParameterError, match=words):
        _pbd.Simulation(body, agents, [], time_step=0.01, substeps=10)


COLUMNS, ROWS, CELL, DENSITY = 13, 4, 0.025, 0.5  # of a strip along x [m, kg/m^2]


def strip(columns, rigidity):
    """A strip at rest whose first columns of vertices a grip holds level."""
    size = (CELL * (COLUMNS - 1), CELL * (ROWS - 1))
    mesh = rectangle(size, (COLUMNS, ROWS), alternate=True)
    fabric = make_fabric(mesh, FabricProperties(DENSITY, 1e-5, 1.0 / rigidity))
    held = [i for i in range(ROWS * COLUMNS) if i % COLUMNS < columns]
    agent = ("hand", held[0], "clamped", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), held[1:])
    simulation = _pbd.Simulation(fabric, [agent], [], time_step=0.01, substeps=40)
    simulation.advance()
    return simulation


def test_two_columns_clamp_the_slope_as_theory_says():
    """A cantilever, clamped in the middle of its first cells: its drop, and its weight's moment."""
    length, width = CELL * (COLUMNS - 1.5), CELL * (ROWS - 1)
    rigidity = DENSITY * 9.81 * length**3 / 8.0
    simulation = strip(2, rigidity)
    points = simulation.points()[0]
    exact = solve_cantilever(length, rigidity * width, DENSITY * 9.81 * width)
    drop = -points[COLUMNS - 1 :: COLUMNS, 2].mean()
    assert drop == pytest.approx(-exact.positions(np.array([length]))[0, 1], rel=0.015)
    force, torque = simulation.wrench(0)
    weight = DENSITY * 9.81 * CELL * (COLUMNS - 1) * width
    assert force[2] == pytest.approx(-weight, rel=0.01)
    arms = points.reshape(ROWS, COLUMNS, 3).mean(axis=0)[:, 0]
    arm = np.trapz(arms, dx=1.0) / (COLUMNS - 1)  # of the weight, from the grip
    assert torque[1] == pytest.approx(weight * arm, rel=0.02)


def test_one_column_leaves_the_slope_open():
    points = strip(1, 0.01).points()[0]
    assert points[COLUMNS - 1 :: COLUMNS, 2].max() < -0.29  # it hangs down
