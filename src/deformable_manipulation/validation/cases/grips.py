"""Grippers of a width: where the rod begins to bend and to twist."""

import numpy as np

from deformable_manipulation.validation.references.elastica import (
    Clamped,
    solve_between,
    solve_cantilever,
)
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    error_check,
    refined,
    relative_check,
)
from deformable_manipulation.validation.rod import (
    ROPE,
    hang,
    make_rod,
    move,
    pitched,
    settle,
)

TITLE = "Grippers of a width"
METHOD = """The paper's rope is clamped by grippers (`grips` of the rod, `grip_length` in a
scenario) that keep 0, 20 or 50 mm of it straight. Theory: the elastica that begins at the
grippers' edges. The deviation is the largest distance between a joint outside the grippers and
the point of the elastica at the same arc length. *Hanging*: between two grippers, at the chords
of the first section. *Cantilever*: one gripper of 20 mm, E from limp to stiff. *Twist*: one of
two grippers of 50 mm turns about the straight rod; the torque is G J times the turn over the
length between the edges."""
CHORDS = {"level": (1.5, 0.0), "not level": (1.3, 0.6)}  # m
LENGTHS = (0.0, 0.02, 0.05)  # m
SEGMENTS = (28, 56, 112)
DEVIATION_TOLERANCES = {  # mm
    "level": {28: 1.0, 56: 0.3, 112: 0.1},
    "not level": {28: 1.6, 56: 0.4, 112: 0.12},
}
LOADS = (1.0, 10.0, 100.0)  # w L^3 / (E I)
DROP_TOLERANCE = 0.2  # % at 28 segments
TURN = 6.0  # rad
TORQUE_TOLERANCE = 0.05  # %


def run(quick: bool = False) -> CaseResult:
    """All grippers; quick: 28 segments."""
    chosen = SEGMENTS[:1] if quick else SEGMENTS
    checks, panels = [], []
    for place, chord in CHORDS.items():
        for length in LENGTHS:
            curves = []
            for segments in chosen:
                check, theory, curve = _hanging(place, chord, length, segments)
                checks.append(check)
                curves.append(curve)
            title = f"{place}, {1e3 * length:g} mm"
            panels.append(Panel(title, "x [m]", "z [m]", [theory, *curves], equal=True))
    checks += [_cantilever(load, segments) for load in LOADS for segments in chosen]
    checks += [_twist(segments) for segments in chosen]
    return CaseResult(TITLE, METHOD, checks, panels)


def _outside(rod, length: float):
    """Joints (J, 2) [m] beyond the first gripper's edge, and their arc lengths (J,) from there."""
    ends = np.array(rod.arc_lengths)
    arc_lengths = ends - 0.5 * ends[1] - 0.5 * length
    return rod.points()[0, 1:-1, ::2], arc_lengths[1:-1]


def _hanging(place, chord, length, segments):
    last = segments - 1
    rod = hang(ROPE, segments, chord, "clamped", grips=[(0, length), (last, length)])
    theory = solve_between(
        rod.free_length(0, last) - length,
        ROPE.bending_stiffness,
        ROPE.weight_per_length,
        (chord[0] - length, chord[1]),
        Clamped(),
        Clamped(),
    )
    joints, arc_lengths = _outside(rod, length)
    edge = np.array([0.5 * length, 0.0])
    away = np.linalg.norm(joints - edge - theory.positions(arc_lengths), axis=1)
    worst = 1e3 * float(away.max())
    check = error_check(
        f"largest deviation, {place}, {1e3 * length:g} mm, {segments} segments",
        worst,
        "mm",
        DEVIATION_TOLERANCES[place][segments],
    )
    x, z = (theory.positions(np.linspace(0.0, theory.length, 200)) + edge).T
    curve = Curve(f"{segments}: {worst:.2f} mm", joints[:, 0], joints[:, 1])
    return check, Curve("theory", x, z, theory=True), curve


def _cantilever(load, segments):
    length = 0.02
    stiffness = ROPE.weight_per_length * ROPE.length**3 / load
    modulus = ROPE.young_modulus * stiffness / ROPE.bending_stiffness
    rod = make_rod(ROPE.with_young_modulus(modulus), segments, grips=[(0, length)])
    rod.hold(0, "clamped", (0.0, 0.0, 0.0), pitched(0.0))
    rod.lay_out()
    settle(rod)
    ends = np.array(rod.arc_lengths)
    free = ROPE.length - 0.5 * ends[1] - 0.5 * length
    theory = solve_cantilever(free, stiffness, ROPE.weight_per_length)
    return relative_check(
        f"tip drop, w L^3 / (E I) = {load:g}, {segments} segments",
        -theory.positions([free])[0, 1],
        -rod.points()[0, -1, 2],
        "m",
        refined(DROP_TOLERANCE, segments),
    )


def _twist(segments):
    """Without gravity, so that the rod is straight."""
    length, last = 0.05, segments - 1
    rod = make_rod(ROPE, segments, gravity=(0.0, 0.0, 0.0), grips=[(0, length), (last, length)])
    between = rod.free_length(0, last)
    for particle, place in ((0, 0.0), (last, between * (1.0 - 1e-6))):
        rod.hold(particle, "clamped", (place, 0.0, 0.0), pitched(0.0))
    rod.lay_out()
    move(rod, last, (0.0, 0.0, 0.0), (TURN, 0.0, 0.0), 2.0)
    settle(rod, speed=1e-7)
    return relative_check(
        f"torque, turned by {TURN:g} rad, {segments} segments",
        ROPE.torsion_stiffness * TURN / (between - length),
        abs(rod.wrench(0)[1][0]),
        "N m",
        TORQUE_TOLERANCE,
    )
