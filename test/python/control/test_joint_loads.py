"""Tension and twist of rods with masses at points, and of rods that are twisted without load."""

import numpy as np
import pytest
import test_loads as loads
from scipy.spatial.transform import Rotation

from deformable_manipulation import _control, _pbd
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

# Off the centres of their segments; the last one is in the segment that the last agent holds.
POINT_MASSES = [(0.31, 0.05), (0.9, 0.08), (1.3, 0.03), (1.98, 0.04)]
PIECE = loads.LENGTH / loads.SEGMENTS
PLAIN = 1500.0 * np.pi * 0.004**2 * PIECE  # kg, of a segment that carries nothing


def masses():
    """The rows (relative mass, lean [m]) of the segments, from the places of the masses."""
    rows = np.tile([1.0, 0.0], (loads.SEGMENTS, 1))
    for at, mass in POINT_MASSES:
        segment = int(at // PIECE)
        rows[segment] += mass / PLAIN * np.array([1.0, at - (segment + 0.5) * PIECE])
    return rows


ROD = dict(
    length=loads.LENGTH,
    radius=0.004,
    density=1500.0,
    segments=loads.SEGMENTS,
    young_modulus=2e8,
    torsion_modulus=7e7,
    stretch="from_moduli",
    damping=10.0,
    solver="direct",
)


@pytest.fixture(scope="module")
def loaded_rod():
    return loads.HeldRod(point_masses=POINT_MASSES)


def barrier(name):
    return loads.barrier(name, turns=True, masses=masses())


@pytest.mark.parametrize("name", ["tension", "twist"])
def test_rows_are_the_gradients_with_point_masses(loaded_rod, name):
    loads.check_turning_rows(loaded_rod, barrier(name), loads.SCALE)


def test_the_tension_is_that_of_the_weights_below(loaded_rod):
    """A rod that hangs from one clamp: the weight of all that is below each joint."""
    rod = _pbd.Rod(
        **ROD,
        gravity=loads.GRAVITY,
        point_masses=POINT_MASSES,
    )
    down = Rotation.from_rotvec([0.0, 0.5 * np.pi, 0.0]).as_quat()
    rod.hold(0, "clamped", (0.0, 0.0, 3.0), down)
    rod.lay_out()
    assert rod.settle(0.01, 2, 1e-8, 60.0)
    found = _pbd.RodEquilibrium()
    found.update(rod, tolerance=1e-10)
    assert found.valid(), found.status()
    below = PLAIN * (loads.SEGMENTS - 1) + sum(mass for _, mass in POINT_MASSES)
    # The other agents hold nothing: their particles are behind the end.
    wrenches = np.vstack((found.wrenches(), np.zeros((2, 6))))
    shape = _control.ObjectShape(3, found.points(), wrenches=wrenches)
    native = loads.barrier("tension", masses=masses(), particles=[0, 99, 99])
    largest = loads.FAR - native.value(loads.HELD, np.inf, 1, shape)
    assert largest == pytest.approx(9.81 * below, rel=1e-6)


def test_the_twist_is_that_between_the_segments_with_point_masses(loaded_rod):
    settled = loaded_rod.settled(loads.TURNED)
    orientations = Rotation.from_quat(settled.orientations())
    between = (orientations[:-1].inv() * orientations[1:]).as_quat()
    twists = 2.0 * np.arctan2(between[:, 0], between[:, 3]) / PIECE
    found = _pbd.RodEquilibrium()
    found.update(settled, tolerance=1e-10)
    shape = _control.ObjectShape(3, found.points(), wrenches=found.wrenches())
    assert np.abs(twists).max() > 0.3  # rad/m
    largest = loads.FAR - barrier("twist").value(loads.HELD, np.inf, 1, shape)
    assert largest == pytest.approx(np.abs(twists).max(), rel=2e-3)
    blind = loads.barrier("twist").value(loads.HELD, np.inf, 1, shape)
    assert loads.FAR - blind != pytest.approx(np.abs(twists).max(), rel=0.02)


def test_a_scenario_tells_its_masses():
    """The tension at the start is the pull of the leader's grip less the weights up to a joint."""
    plugs = [{"at": 0.5, "mass": 0.1}, {"at": 1.8, "mass": 0.05}]
    overrides = [
        ("object.point_masses", str(plugs)),
        ("controller.tension", "{max_tension: 50.0}"),
        ("controller.twist", "{max_twist: 5.0}"),
        ("simulation.duration", "0.05"),
    ]
    scenario = load_scenario("rope_one_assistant", overrides)
    masses, moments = scenario.object.segment_masses()
    assert masses.sum() == pytest.approx(scenario.object.mass)
    piece = scenario.object.length / scenario.object.segments
    places = (np.arange(len(masses)) + 0.5) * piece
    plain = scenario.object.mass_per_length * scenario.object.length
    first = plain * 0.5 * scenario.object.length + 0.5 * 0.1 + 1.8 * 0.05
    assert masses @ places + moments.sum() == pytest.approx(first)
    loop = ClosedLoop(scenario)
    decision = loop.step().decisions["assistant_1"]
    points, force = loop._simulation.points()[0], loop._simulation.wrench(0)[0]
    along = points[2:] - points[:-2]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    pulls = force - np.cumsum(masses[:-1])[:, None] * loads.GRAVITY
    tensions = np.einsum("ij,ij->i", pulls, along)
    assert 50.0 - decision.h["tension"] == pytest.approx(tensions.max(), rel=1e-3)
    even = np.cumsum(np.full(len(masses) - 1, scenario.object.mass / len(masses)))
    blind = np.einsum("ij,ij->i", force - even[:, None] * loads.GRAVITY, along)
    assert blind.max() != pytest.approx(tensions.max(), rel=0.02)


NATURAL_TWIST = 1.5  # rad/m
SPAN = loads.LENGTH - PIECE  # m, between the centres of the first and the last segment


def straight_rod(angle):
    """The twist [rad/m] that the limit counts of a rod of natural twist between two clamps.

    It is weightless, straight and a little taut; one clamp is turned against the other by an angle
    [rad] about the rod.
    """
    rod = _pbd.Rod(
        **ROD,
        gravity=np.zeros(3),
        natural_twist=NATURAL_TWIST,
    )
    turn = Rotation.from_rotvec([angle, 0.0, 0.0]).as_quat()
    rod.hold(0, "clamped", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    rod.hold(loads.SEGMENTS - 1, "clamped", (1.002 * SPAN, 0.0, 0.0), turn)
    rod.lay_out()
    rod.settle(0.01, 4, 1e-6, 60.0)
    found = _pbd.RodEquilibrium()
    found.update(rod, tolerance=1e-8, iterations=200)
    assert found.valid(), found.status()
    wrenches = np.vstack((found.wrenches(), np.zeros((1, 6))))
    shape = _control.ObjectShape(3, found.points(), wrenches=wrenches)
    held = {"weight": np.zeros(3), "particles": [0, loads.SEGMENTS - 1, 99]}
    return loads.FAR - loads.barrier("twist", **held).value(loads.HELD, np.inf, 1, shape)


@pytest.mark.parametrize("angle", [0.0, 1.0, 4.0, 2.0 * NATURAL_TWIST * SPAN - 0.5])
def test_the_limit_counts_the_twist_beyond_the_natural_one(angle):
    """Linear theory: the clamps' angle over the length between them, less the natural twist."""
    assert straight_rod(angle) == pytest.approx(abs(angle / SPAN - NATURAL_TWIST), rel=2e-3)


def test_a_rod_that_is_twisted_as_by_nature_bears_nothing():
    assert straight_rod(NATURAL_TWIST * SPAN) < 1e-6


def test_natural_curvature_leaves_the_twist_nearly_right():
    """Of a rod at rest in space: within what a joint's bending moment has along the rod."""
    twist, curvature = 0.5, np.array([0.4, -0.3])  # rad/m, 1/m
    rod = loads.HeldRod(natural_twist=twist, natural_curvature=curvature)
    settled = rod.settled(loads.TURNED)
    orientations = Rotation.from_quat(settled.orientations())
    between = (orientations[:-1].inv() * orientations[1:]).as_quat()
    beyond = 2.0 * np.arctan2(between[:, 0], between[:, 3]) / PIECE - twist
    directions = orientations.apply([1.0, 0.0, 0.0])
    bent = np.linalg.norm(np.diff(directions, axis=0), axis=1).max() / PIECE
    stiffness = 2e8 / (2.0 * 7e7)  # bending over torsion, of a circular cross-section
    error = stiffness * PIECE * bent * np.linalg.norm(curvature) / 2.0
    found = _pbd.RodEquilibrium()
    found.update(settled, tolerance=1e-10)
    assert found.valid(), found.status()
    shape = _control.ObjectShape(3, found.points(), wrenches=found.wrenches())
    counted = loads.FAR - loads.barrier("twist").value(loads.HELD, np.inf, 1, shape)
    largest = np.abs(beyond).max()
    assert error < 0.2 * largest
    assert counted == pytest.approx(largest, abs=error)
