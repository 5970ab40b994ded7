"""A rod clamped at one end droops under its weight, from nearly rigid to nearly limp."""

import numpy as np

from deformable_manipulation.validation.references.elastica import solve_cantilever
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    error_check,
    percent_of,
    refined,
    relative_check,
)
from deformable_manipulation.validation.rod import (
    ROPE,
    STIFF_ROD,
    joint_arc_lengths,
    make_rod,
    settle,
)

TITLE = "Cantilever over the whole range of stiffness"
METHOD = """One end is clamped level and the other is free. The clamp is at the centre of the
first segment, so the free length is L - l/2 with the segment length l. E is chosen to give a
dimensionless weight w L^3 / (E I) from 0.01 (a beam whose tip drops by w L^4 / (8 E I)) to 1000
(it hangs straight down except for a bend at the clamp). Theory: the elastica. The stiff rod (E
30 GPa) has a weight of about 2.1."""
SEGMENTS = (28, 45, 100)
LOADS = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
QUICK_LOADS = (0.1, 10.0, 1000.0)
# Percent at 28 segments; the errors shrink with the square of the segment length. The limp rods
# bend within a few segments of that length.
STIFF_TOLERANCE = 0.2
DROP_TOLERANCES = {0.01: 0.1, 0.1: 0.1, 1.0: 0.1, 10.0: 0.1, 100.0: 0.1, 1000.0: 0.5}
SHAPE_TOLERANCES = {0.01: 1e-4, 0.1: 1e-3, 1.0: 0.01, 10.0: 0.08, 100.0: 0.25, 1000.0: 0.7}


def run(quick: bool = False) -> CaseResult:
    """Let rods of all stiffnesses droop; quick: three of them, 28 segments."""
    counts = SEGMENTS[:1] if quick else SEGMENTS
    loads = QUICK_LOADS if quick else LOADS
    checks, shapes = [], []
    drops = {segments: [] for segments in counts}
    for segments in counts:
        length = _free_length(segments)
        for load in loads:
            stiffness = ROPE.weight_per_length * length**3 / load
            modulus = ROPE.young_modulus * stiffness / ROPE.bending_stiffness
            properties = ROPE.with_young_modulus(modulus)
            shape, points, arcs = _droop(properties, segments)
            name = f"w L^3 / (E I) = {load:g}, {segments} segments"
            drop = relative_check(
                f"tip drop, {name}",
                -shape.positions([length])[0, 1],
                -points[-1, 1],
                "m",
                refined(DROP_TOLERANCES[load], segments),
            )
            away = percent_of(points - shape.positions(arcs), ROPE.length)
            tolerance = refined(SHAPE_TOLERANCES[load], segments)
            checks += [drop, error_check(f"largest deviation / L, {name}", away, "%", tolerance)]
            drops[segments].append(drop.error)
            if segments == SEGMENTS[0]:
                shapes += _curves(load, shape, points, away, tolerance)
        checks.append(_stiff_rod(segments))
    limits = [DROP_TOLERANCES[load] for load in loads]
    panels = [
        Panel("28 segments, marks: simulation", "x [m]", "z [m]", shapes, equal=True),
        Panel(
            "error of the tip drop",
            "w L^3 / (E I)",
            "%",
            [
                Curve("tolerance at 28 segments", loads, limits, theory=True),
                *(Curve(f"{n} segments", loads, errors) for n, errors in drops.items()),
            ],
            x_scale="log",
            y_scale="log",
        ),
    ]
    return CaseResult(TITLE, METHOD, checks, panels)


def _free_length(segments: int) -> float:
    return ROPE.length * (1.0 - 0.5 / segments)


def _droop(properties, segments):
    """Theory, simulated joints and tip (N, 2) [m] from the grip, and their arc lengths [m]."""
    length = _free_length(segments)
    shape = solve_cantilever(length, properties.bending_stiffness, properties.weight_per_length)
    rod = make_rod(properties, segments)
    rod.hold(0)
    settle(rod)
    points = (rod.points()[0, 1:] - rod.positions()[0])[:, ::2]
    return shape, points, np.append(joint_arc_lengths(properties, segments), length)


def _stiff_rod(segments):
    shape, points, arcs = _droop(STIFF_ROD, segments)
    return relative_check(
        f"tip drop, E 30 GPa, {segments} segments",
        -shape.positions(arcs[-1:])[0, 1],
        -points[-1, 1],
        "m",
        refined(STIFF_TOLERANCE, segments),
    )


def _curves(load, shape, points, away, tolerance):
    x, z = shape.positions(np.linspace(0.0, shape.length, 100)).T
    label = f"{load:g}: {away:.2g} % (at most {tolerance:g} %)"
    return [Curve("", x, z, theory=True), Curve(label, points[:, 0], points[:, 1])]
