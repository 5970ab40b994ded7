"""A rod clamped at both ends, one end moved out of the plane and turned."""

import numpy as np

from deformable_manipulation.validation.references.elastica import Clamped, solve_between
from deformable_manipulation.validation.references.kirchhoff import (
    Ends,
    KirchhoffProblem,
    KirchhoffRod,
)
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
    move,
    settle,
)

TITLE = "End moved out of the plane and turned"
METHOD = """The rod hangs clamped between two grips 1.5 m apart. Then one grip moves to (1.2,
0.5, 0.3) m and turns by the rotation vector (1.0, 0.4, -0.8) rad within 10 s. Theory: the
Kirchhoff rod in space with bending and twist, followed from the planar shape along the same
path."""
GRIP = (1.5, 0.0)
GOAL = np.array([1.2, 0.5, 0.3])  # m
TURN = np.array([1.0, 0.4, -0.8])  # rad
STEPS = 20
DURATION = 10.0  # s
SEGMENTS = (28, 45, 100)
MODULI = {"E 30 MPa": 30e6, "E 3 GPa": 3e9}  # Pa
# At 28 segments. The rope bends sharply at its clamps, within two segments of that length.
TOLERANCE = {"E 30 MPa": 1.3, "E 3 GPa": 0.15}  # %


def run(quick: bool = False) -> CaseResult:
    """Move the end of the rope and of a stiffer rod; quick: the stiffer one, 28 segments."""
    checks, panels = [], []
    for name in ["E 3 GPa"] if quick else list(MODULI):
        properties = ROPE.with_young_modulus(MODULI[name])
        curves = []
        for segments in SEGMENTS[:1] if quick else SEGMENTS:
            truth, rod = follow(properties, segments), simulate(properties, segments)
            joints = rod.points()[0, 1:-1]
            expected = truth.positions(joint_arc_lengths(properties, segments))
            away = percent_of(joints - expected, properties.length)
            tolerance = refined(TOLERANCE[name], segments)
            quantity = f"largest deviation / L, {name}, {segments} segments"
            checks.append(error_check(quantity, away, "%", tolerance))
            curves.append((f"{segments}: {away:.3f} % (at most {tolerance:.2g} %)", joints))
        line = truth.positions(np.linspace(0.0, truth.length, 200))
        for axis, view in ((1, "y"), (2, "z")):
            panels.append(_panel(f"{name}, x-{view}", view, axis, line, curves))
    return CaseResult(TITLE, METHOD, checks, panels)


def follow(properties: RodProperties, segments: int) -> KirchhoffRod:
    """The theory: the moved rod, for the free length that a number of segments leaves."""
    length = properties.length * (segments - 1) / segments
    bending, weight = properties.bending_stiffness, properties.weight_per_length
    planar = solve_between(length, bending, weight, GRIP, Clamped(), Clamped())
    problem = KirchhoffProblem(length, bending, properties.torsion_stiffness, weight)
    start = np.array([GRIP[0], 0.0, GRIP[1]])
    fractions = np.linspace(0.0, 1.0, STEPS + 1)[1:]
    path = [Ends(start + f * (GOAL - start), f * TURN) for f in fractions]
    return problem.follow(path, problem.nodes(), problem.planar_guess(planar))


def simulate(properties: RodProperties, segments: int):
    """The simulated rod at rest after the same move."""
    rod = hang(properties, segments, GRIP, "clamped")
    start = np.array([GRIP[0], 0.0, GRIP[1]])
    move(rod, segments - 1, GOAL - start, TURN, DURATION)
    settle(rod)
    return rod


def _panel(title, view, axis, line, curves):
    theory = Curve("Kirchhoff rod", line[:, 0], line[:, axis], theory=True)
    marks = [Curve(label, joints[:, 0], joints[:, axis]) for label, joints in curves]
    return Panel(title, "x [m]", f"{view} [m]", [theory, *marks], equal=True)
