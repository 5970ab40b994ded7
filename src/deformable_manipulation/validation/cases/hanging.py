"""A rope held at both ends, level and not, pinned and clamped."""

import numpy as np

from deformable_manipulation.validation.references.discrete_chain import solve_chain
from deformable_manipulation.validation.references.elastica import (
    Clamped,
    Pinned,
    solve_between,
)
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    percent_of,
    ratio_check,
    relative_check,
)
from deformable_manipulation.validation.rod import ROPE, hang, joint_arc_lengths

TITLE = "Rope held at both ends"
METHOD = """The paper's rope (E 30 MPa) hangs between two grips, either 1.5 m apart at the same
height or 1.3 m apart with one 0.6 m higher. Theory: the elastica from grip to grip with the free
length L (N-1)/N. A pinned grip carries the weight of the half segment beyond it. The deviation
is the largest distance between a joint of the simulated rod and the point of the elastica at the
same arc length. The *theory* of a deviation is the best that N rigid segments can reach:
Newton's method makes their energy stationary. A clamped grip keeps half a segment straight,
which causes most of that deviation."""
CHORDS = {"level": (1.5, 0.0), "not level": (1.3, 0.6)}  # m
SEGMENTS = (28, 45, 100)
TIMES_REACHABLE = 1.2
TENSION_TOLERANCE = 0.5  # %
WEIGHT_TOLERANCE = 0.1  # %


def run(quick: bool = False) -> CaseResult:
    """Hang the rope in all four ways; quick: level, 28 and 45 segments."""
    checks, panels = [], []
    places = ["level"] if quick else list(CHORDS)
    for hold in ("pinned", "clamped"):
        for place in places:
            curves = []
            for segments in SEGMENTS[:2] if quick else SEGMENTS:
                shape, rod = _solutions(hold, CHORDS[place], segments)
                name = f"{hold}, {place}, {segments} segments"
                checks += _compare(name, hold, shape, rod, segments)
                x, z = shape.positions(np.linspace(0.0, shape.length, 200)).T
                name = "" if curves else "elastica of each free length"
                curves.append(Curve(name, x, z, theory=True))
                joints = rod.points()[0, 1:-1]
                error, tolerance = checks[-3].measured, TIMES_REACHABLE * checks[-3].theory
                label = f"{segments}: {error:.3f} % (at most {tolerance:.3f} %)"
                curves.append(Curve(label, joints[:, 0], joints[:, 2]))
            panels.append(Panel(f"{hold}, {place}", "x [m]", "z [m]", curves, equal=True))
    return CaseResult(TITLE, METHOD, checks, panels)


def _ends(hold: str, segments: int):
    end = Clamped() if hold == "clamped" else Pinned(0.5 * ROPE.length / segments)
    return end, end


def _solutions(hold, chord, segments):
    length = ROPE.length * (segments - 1) / segments
    shape = solve_between(
        length, ROPE.bending_stiffness, ROPE.weight_per_length, chord, *_ends(hold, segments)
    )
    return shape, hang(ROPE, segments, chord, hold)


def _compare(name, hold, shape, rod, segments):
    chain = solve_chain(
        shape,
        segments,
        ROPE.bending_stiffness,
        ROPE.weight_per_length,
        *_ends(hold, segments),
    )
    truth = shape.positions(joint_arc_lengths(ROPE, segments))
    measured = percent_of(rod.points()[0, 1:-1, ::2] - truth, ROPE.length)
    reachable = percent_of(chain.joints() - truth, ROPE.length)
    first, last = (rod.wrench(particle)[0] for particle in (0, segments - 1))
    weight = ROPE.weight_per_length * ROPE.length
    return [
        ratio_check(f"largest deviation / L, {name}", reachable, measured, "%", TIMES_REACHABLE),
        relative_check(
            f"horizontal tension, {name}",
            shape.forces([0.0])[0, 0],
            first[0],
            "N",
            TENSION_TOLERANCE,
        ),
        relative_check(
            f"sum of reactions, {name}", weight, -(first + last)[2], "N", WEIGHT_TOLERANCE
        ),
    ]
