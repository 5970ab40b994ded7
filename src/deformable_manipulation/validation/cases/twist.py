"""A straight rod, clamped at both ends, whose one end is turned about its axis."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from deformable_manipulation.validation.references.twist import (
    critical_moment_factor,
    critical_turn,
    reaction_torque,
)
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    refined,
    relative_check,
)
from deformable_manipulation.validation.rod import ROPE, make_rod, move, settle

TITLE = "Twist"
METHOD = """There is no gravity. E is 30 MPa, G is 10 MPa, and the free length between the clamps
is L (N-1)/N. *Before the critical twist*, one end of the straight rod is turned by up to 6 rad.
Theory: the torque G J phi / L. *The critical twist* is that of a rod with one sliding end: the
straight rod without thrust buckles at a torque of 8.9868 E I / L. A grip of the simulator does
not slide. Instead the end is first pushed in a little, by 0.05 % and 0.1 % of the length, which
bends the rod sideways, and then turned step by step. Where its axial reaction changes from
thrust to tension, it would rest on a slide: the rod is on the buckled path of the sliding rod,
which begins at the critical twist. Linear extrapolation of the two twists to zero push gives
that beginning. *Many turns*: the straight rod is turned by up to 20 turns. It cannot leave its
line, as its ends do not approach each other."""
SEGMENTS = (28, 45, 100)
TURNS = (1.0, 2.0, 4.0, 6.0, 5 * 2 * np.pi, 20 * 2 * np.pi)  # rad
TORQUE_TOLERANCE = 0.05  # %
CRITICAL_TOLERANCE = 2.0  # %
CRITICAL_TORQUE_TOLERANCE = 2.0  # % at 28 segments
PUSHES = (5e-4, 1e-3)  # of the free length
FRACTIONS = (0.96, 0.99, 1.02, 1.05)  # of the critical turn: where the reaction is read
TURNING_SPEED = 2.0  # rad/s
SIDEWAYS = (0.0, 0.0, 1e-6)  # m/s^2, only decides to which side the rod bends
REST = 1e-8  # m/s


@dataclass(frozen=True)
class Slide:
    """Where the axial reaction vanishes: turn [rad] and torque [N m] there."""

    turn: float
    torque: float


def run(quick: bool = False) -> CaseResult:
    """Turn the end of a straight and of a pushed-in rod; quick: 28 segments."""
    checks, torques, thrusts = [], [], []
    truth = critical_turn(ROPE.bending_stiffness, ROPE.torsion_stiffness)
    for segments in SEGMENTS[:1] if quick else SEGMENTS:
        length = ROPE.length * (segments - 1) / segments
        checks += _straight(segments, length, torques)
        slides = [_slide(segments, length, push, truth, thrusts) for push in PUSHES]
        turn = _at_no_push([slide.turn for slide in slides])
        torque = _at_no_push([slide.torque for slide in slides])
        moment = critical_moment_factor() * ROPE.bending_stiffness / length
        name = f"{segments} segments"
        checks += [
            relative_check(f"critical twist, {name}", truth, turn, "rad", CRITICAL_TOLERANCE),
            relative_check(
                f"critical torque, {name}",
                moment,
                torque,
                "N m",
                refined(CRITICAL_TORQUE_TOLERANCE, segments),
            ),
        ]
    panels = [
        Panel("error of the torque before", "turn [rad]", "%", torques, y_scale="log"),
        Panel(
            "axial reaction of the end pushed in",
            "turn / critical turn of theory",
            "thrust L^2 / (E I)",
            thrusts,
            limit=0.0,
        ),
    ]
    return CaseResult(TITLE, METHOD, checks, panels)


def _straight(segments, length, curves):
    rod = make_rod(ROPE, segments, gravity=(0.0, 0.0, 0.0))
    rod.hold(0)
    rod.hold(segments - 1)
    checks, before = [], 0.0
    for turn in TURNS:
        move(rod, segments - 1, (0.0, 0.0, 0.0), (turn - before, 0.0, 0.0), 2.0 + 0.2 * turn)
        settle(rod)
        before = turn
        theory = reaction_torque(ROPE.torsion_stiffness, length, turn)
        measured = -rod.wrench(segments - 1)[1][0]
        name = f"torque, turned by {turn:g} rad, {segments} segments"
        checks.append(relative_check(name, theory, measured, "N m", TORQUE_TOLERANCE))
    errors = [check.error for check in checks]
    label = f"{segments}: {errors[-1]:.3f} % (at most {checks[-1].tolerance:.2g} %)"
    curves.append(Curve(label, TURNS, errors))
    return checks


def _slide(segments, length, push, truth, curves) -> Slide:
    rod = make_rod(ROPE, segments, gravity=SIDEWAYS)
    rod.hold(0)
    rod.hold(segments - 1)
    move(rod, segments - 1, (-push * length, 0.0, 0.0), (0.0, 0.0, 0.0), 2.0)
    settle(rod, speed=REST)
    turns, thrusts, torques, before = [], [], [], 0.0
    for turn in truth * np.array(FRACTIONS):
        turned = (turn - before, 0.0, 0.0)
        move(rod, segments - 1, (0.0, 0.0, 0.0), turned, (turn - before) / TURNING_SPEED)
        settle(rod, speed=REST)
        force, moment = rod.wrench(segments - 1)
        turns.append(turn)
        thrusts.append(force[0])
        torques.append(-moment[0])
        before = turn
    slide = Slide(np.nan, np.nan)
    if thrusts[0] > 0.0 > thrusts[-1]:
        turn = float(PchipInterpolator(-np.array(thrusts), turns)(0.0))
        slide = Slide(turn, float(np.interp(turn, turns, torques)))
    off = 100.0 * (slide.turn / truth - 1.0)
    label = f"{segments}, pushed {100 * push:g} %: {off:.2f} % (at most {CRITICAL_TOLERANCE:g} %)"
    scale = length**2 / ROPE.bending_stiffness
    curves.append(Curve(label, np.array(turns) / truth, np.array(thrusts) * scale))
    return slide


def _at_no_push(values) -> float:
    slope = (values[1] - values[0]) / (PUSHES[1] - PUSHES[0])
    return values[0] - slope * PUSHES[0]
