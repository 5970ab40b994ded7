"""Rods that are curved and twisted without load: arcs, helices, and what weight makes of them."""

import numpy as np

from deformable_manipulation.validation.references.bent_cantilever import BentCantilever
from deformable_manipulation.validation.references.elastica import Clamped, solve_between
from deformable_manipulation.validation.references.kirchhoff import Ends, KirchhoffProblem
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    error_check,
    percent_of,
    refined,
)
from deformable_manipulation.validation.rod import (
    ROPE,
    RodProperties,
    hang,
    joint_arc_lengths,
    make_rod,
    pitched,
    settle,
)

TITLE = "Natural curvature and twist"
METHOD = """A rod of 1.2 m (E 3 GPa) is curved without load, about the z axis of its segments
(*coil*), or about their y axis, which lies level (*tube*). *Coil without weight*: clamped at
its first end, with a curvature of 4/m and a twist of 2 rad/m; theory: the helix of these. *Coil
under its weight*: the same under gravity; theory: the Kirchhoff rod with a free end, its weight
put on in steps. *Tube*: a curvature of -0.8/m, upwards, as a cantilever of 1 m; theory: the
elastica of that curvature. *Bent rope*: E 30 MPa, between level clamps 1.5 m apart, with a
curvature of 1/m about both axes and a twist of 1 rad/m; theory: the Kirchhoff rod, followed
from the straight rope's shape as its curvature grows."""
COIL = (2.0, 0.0, 4.0)  # rad/m, 1/m, 1/m
TUBE_LENGTH, TUBE_CURVATURE = 1.0, -0.8  # m, 1/m
BENT_ROPE = (1.0, 1.0, 1.0)
GRIP = (1.5, 0.0)
STIFF = RodProperties(1.2, young_modulus=3e9, torsion_modulus=1e9)
SEGMENTS = (28, 56, 112)
# At 28 segments [%]. The rope bends sharply at its clamps, within two segments of that length.
TOLERANCE = {"coil without weight": 0.15, "coil": 0.4, "tube": 0.05, "bent rope": 1.3}
STEPS = 20


def run(quick: bool = False) -> CaseResult:
    """All rods; quick: 28 segments, without the bent rope."""
    checks, panels = [], []
    rods = {
        "coil without weight": _free_coil,
        "coil": _coil,
        "tube": _tube,
        "bent rope": _bent_rope,
    }
    if quick:
        del rods["bent rope"]
    for name, compare in rods.items():
        curves = []
        for segments in SEGMENTS[:1] if quick else SEGMENTS:
            measured, truth, length = compare(segments)
            away = percent_of(measured - truth, length)
            quantity = f"largest deviation / L, {name}, {segments} segments"
            checks.append(error_check(quantity, away, "%", refined(TOLERANCE[name], segments)))
            curves.append(Curve(f"{segments}: {away:.3f} %", measured[:, 0], measured[:, -1]))
        theory = Curve("theory", truth[:, 0], truth[:, -1], theory=True)
        panels.append(Panel(name, "x [m]", "z [m]", [theory, *curves], equal=True))
    return CaseResult(TITLE, METHOD, checks, panels)


def _clamped_rod(properties, segments, natural, **options):
    """At its first segment's centre, along x; at rest."""
    rod = make_rod(
        properties,
        segments,
        natural_twist=natural[0],
        natural_curvature=natural[1:],
        **options,
    )
    rod.hold(0, "clamped", (0.0, 0.0, 0.0), pitched(0.0))
    rod.lay_out()
    settle(rod)
    return rod


def _free_coil(segments):
    rod = _clamped_rod(STIFF, segments, COIL, gravity=(0.0, 0.0, 0.0))
    arcs = joint_arc_lengths(STIFF, segments)
    return rod.points()[0, 1:-1], helix(COIL, arcs), STIFF.length


def helix(natural, arcs: np.ndarray) -> np.ndarray:
    """Points (n, 3) [m] of a helix of twist and curvatures (3,), from the origin along x.

    The frame turns steadily about the Darboux vector; the integral of its x axis has the part along
    that vector and a part around it.
    """
    natural = np.asarray(natural, dtype=float)
    rate = np.linalg.norm(natural)
    axis = natural / rate
    along = axis * axis[0]
    across = np.array([1.0, 0.0, 0.0]) - along
    around = np.cross(axis, across)
    turn = rate * arcs[:, None]
    return arcs[:, None] * along + (np.sin(turn) * across + (1.0 - np.cos(turn)) * around) / rate


def _coil(segments):
    rod = _clamped_rod(STIFF, segments, COIL)
    length = STIFF.length * (segments - 0.5) / segments
    truth = KirchhoffProblem(
        length,
        STIFF.bending_stiffness,
        STIFF.torsion_stiffness,
        STIFF.weight_per_length,
        COIL,
    ).hang_freely(STEPS)
    arcs = joint_arc_lengths(STIFF, segments)
    return rod.points()[0, 1:-1], truth.positions(arcs), STIFF.length


def _tube(segments):
    properties = RodProperties(TUBE_LENGTH, young_modulus=3e9, torsion_modulus=1e9)
    # From x towards z is against the y axis.
    rod = _clamped_rod(properties, segments, (0.0, TUBE_CURVATURE, 0.0))
    truth = BentCantilever(
        TUBE_LENGTH * (segments - 0.5) / segments,
        properties.bending_stiffness,
        properties.weight_per_length,
        natural_curvature=-TUBE_CURVATURE,
    )
    arcs = joint_arc_lengths(properties, segments)
    return rod.points()[0, 1:-1, ::2], truth.positions(arcs), TUBE_LENGTH


def _bent_rope(segments):
    rod = hang(ROPE, segments, GRIP, "clamped")
    shape = rod.points()[0]
    bent = make_rod(
        ROPE,
        segments,
        natural_twist=BENT_ROPE[0],
        natural_curvature=BENT_ROPE[1:],
    )
    for held in (0, segments - 1):
        bent.hold(held, "clamped", rod.positions()[held], pitched(0.0))
    bent.set_state(shape, np.zeros_like(shape))
    settle(bent)
    length = ROPE.length * (segments - 1) / segments
    stiffness, weight = ROPE.bending_stiffness, ROPE.weight_per_length
    planar = solve_between(length, stiffness, weight, GRIP, Clamped(), Clamped())
    problem = KirchhoffProblem(length, stiffness, ROPE.torsion_stiffness, weight)
    nodes, guess = problem.nodes(), problem.planar_guess(planar)
    ends = Ends((GRIP[0], 0.0, GRIP[1]))
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        problem = KirchhoffProblem(
            length, stiffness, ROPE.torsion_stiffness, weight, share * np.array(BENT_ROPE)
        )
        truth = problem.follow([ends], nodes, guess)
        nodes, guess = truth.bvp.x, truth.bvp.y
    return bent.points()[0, 1:-1], truth.positions(joint_arc_lengths(ROPE, segments)), ROPE.length
