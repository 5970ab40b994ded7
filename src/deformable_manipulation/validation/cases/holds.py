"""Several held points: interior ones, clamped and pinned, and adjacent ones."""

import numpy as np

from deformable_manipulation.validation.references.discrete_chain import ChainProblem
from deformable_manipulation.validation.references.elastica import (
    Clamped,
    Pinned,
    solve_between,
    solve_cantilever,
    solve_spans,
)
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    percent_of,
    ratio_check,
    refined,
    relative_check,
)
from deformable_manipulation.validation.rod import ROPE, STIFF_ROD, make_rod, pitched, settle

TITLE = "Several held points"
METHOD = """*Four grips*: the rope hangs from its ends and from two points between them, at
different heights. With clamped grips, every span is a separate elastica. With pinned grips,
angle and moment are continuous across a pin, and the spans form one boundary value problem.
*Adjacent grips*: two neighbouring segments in the middle are clamped in line, in addition to
both ends. The spans on either side are elasticas again. *Clamped over two segments*: the first
two segments of a stiff rod are held. It droops as a cantilever whose clamp is at the centre of
the second segment, and the first grip carries only its own segment. Deviations are those of the
joints. Forces are those of the grips (of neighbours together) and are compared with the ends of
the spans. The *theory* of both is again the best that N rigid segments held in the same way can
reach."""
SEGMENTS = (28, 100)
# Places of the grips, x and z [m].
FOUR_POINTS = np.array([[0.0, 0.0], [0.5, 0.1], [1.1, -0.1], [1.6, 0.05]])
ADJACENT_ENDS = np.array([[0.0, 0.0], [0.75, 0.1], [1.5, 0.0]])
TIMES_REACHABLE = 1.2
WEIGHT_TOLERANCE = 0.1  # %
DROP_TOLERANCE = 0.2  # % at 28 segments


def run(quick: bool = False) -> CaseResult:
    """Hold the rope in four ways; quick: with 28 segments."""
    checks, panels = [], {}
    for segments in SEGMENTS[:1] if quick else SEGMENTS:
        thirds = [round(k * (segments - 1) / 3) for k in range(4)]
        for hold in ("clamped", "pinned"):
            checks += _compare(hold, hold, segments, thirds, FOUR_POINTS, panels)
        middle = segments // 2 - 1
        pair = [0, middle, middle + 1, segments - 1]
        along = np.array([ROPE.length / segments, 0.0])
        places = np.vstack([ADJACENT_ENDS[:2], ADJACENT_ENDS[1] + along, ADJACENT_ENDS[2] + along])
        checks += _compare("adjacent", "clamped", segments, pair, places, panels)
        checks += _clamped_over_two(segments)
    return CaseResult(TITLE, METHOD, checks, list(panels.values()))


def _compare(name, hold, segments, grips, places, panels):
    rod = make_rod(ROPE, segments)
    for particle, (x, z) in zip(grips, places):
        rod.hold(particle, hold, (x, 0.0, z), pitched(0.0))
    rod.lay_out()
    settle(rod)
    spans = _spans(hold, segments, grips, places)
    chain = _chain(hold, segments, grips, places, spans)
    expected = _together(grips, _grip_forces(segments, grips, spans))
    forces = _together(grips, np.array([rod.wrench(particle)[0][::2] for particle in grips]))
    weight = ROPE.weight_per_length * ROPE.length
    case = f"{name}, {segments} segments"
    reachable = _deviation(chain.joints(), segments, spans)
    checks = [
        ratio_check(
            f"largest deviation / L, {case}",
            reachable,
            _deviation(rod.points()[0, 1:-1, ::2], segments, spans),
            "%",
            TIMES_REACHABLE,
        ),
        ratio_check(
            f"worst force of a grip / weight, {case}",
            percent_of(chain.grip_forces - expected, weight),
            percent_of(forces - expected, weight),
            "%",
            TIMES_REACHABLE,
        ),
        relative_check(
            f"sum of reactions, {case}", weight, -forces[:, 1].sum(), "N", WEIGHT_TOLERANCE
        ),
    ]
    away, most = checks[0].measured, TIMES_REACHABLE * reachable
    _draw(panels, name, rod, spans, f"{segments}: {away:.3f} % (at most {most:.3f} %)")
    return checks


def _chain(hold, segments, grips, places, spans):
    length = ROPE.length / segments
    angles = np.zeros(segments)
    for grip, _, shape in spans:
        count = int(round(shape.length / length))
        angles[grip : grip + count + 1] = shape.angles(np.linspace(0.0, shape.length, count + 1))
    clamped = dict.fromkeys(grips, 0.0) if hold == "clamped" else {}
    material = ROPE.bending_stiffness, ROPE.weight_per_length
    apart = _first_of_neighbours(grips)  # the next one's place follows from its angle
    held = list(np.array(grips)[apart])
    return ChainProblem(length, *material, held, places[apart], clamped).solve(angles)


def _first_of_neighbours(grips) -> np.ndarray:
    """Whether each grip is on its own or the first of two on neighbouring segments."""
    return np.append(True, np.diff(grips) > 1)


def _together(grips, forces) -> np.ndarray:
    """The forces (A, 2) of grips, with those of neighbours added up."""
    return np.add.reduceat(forces, np.flatnonzero(_first_of_neighbours(grips)))


def _spans(hold, segments, grips, places):
    """The slack spans: (first grip, place, elastica) each; adjacent grips have none between."""
    length = ROPE.length / segments
    counts = np.diff(grips)
    material = ROPE.bending_stiffness, ROPE.weight_per_length
    if hold == "pinned":
        end = Pinned(0.5 * length)
        shapes = solve_spans(counts * length, *material, places, end, end)
        return list(zip(grips, np.zeros_like(places), shapes))
    return [
        (grip, here, solve_between(count * length, *material, there - here, Clamped(), Clamped()))
        for grip, count, here, there in zip(grips, counts, places[:-1], places[1:])
        if count > 1
    ]


def _deviation(joints, segments, spans) -> float:
    """Largest distance [% of L] of the joints (N - 1, 2) from the spans."""
    length = ROPE.length / segments
    worst = 0.0
    for grip, place, shape in spans:
        arcs = np.arange(0.5 * length, shape.length, length)
        span = joints[grip : grip + len(arcs)]
        worst = max(worst, percent_of(span - place - shape.positions(arcs), ROPE.length))
    return worst


def _grip_forces(segments, grips, spans) -> np.ndarray:
    """Forces (A, 2) [N] on the grips: of the spans, and of half segments at the rope's ends."""
    length = ROPE.length / segments
    forces = np.zeros((len(grips), 2))
    forces[[0, -1], 1] -= 0.5 * ROPE.weight_per_length * length
    for grip, _, shape in spans:
        index = grips.index(grip)
        forces[index] += shape.forces([0.0])[0]
        forces[index + 1] -= shape.forces([shape.length])[0]
    between = np.flatnonzero(np.diff(grips) == 1)  # held segments in line carry their own halves
    for index in between:
        forces[[index, index + 1], 1] -= 0.5 * ROPE.weight_per_length * length
    return forces


def _draw(panels, name, rod, spans, label):
    points = rod.points()[0]
    mark = Curve(label, points[:, 0], points[:, 2])
    if name in panels:
        panels[name].curves.append(mark)
        return
    curves = []
    for _, place, shape in spans:
        x, z = (place + shape.positions(np.linspace(0.0, shape.length, 100))).T
        curves.append(Curve("" if curves else "elastica", x, z, theory=True))
    title = {"adjacent": "clamped, two neighbours in the middle"}.get(name, f"four grips, {name}")
    panels[name] = Panel(title, "x [m]", "z [m]", [*curves, mark], equal=True)


def _clamped_over_two(segments):
    length = STIFF_ROD.length / segments
    rod = make_rod(STIFF_ROD, segments)
    rod.hold(0)
    rod.hold(1)
    settle(rod)
    free = STIFF_ROD.length - 1.5 * length
    shape = solve_cantilever(free, STIFF_ROD.bending_stiffness, STIFF_ROD.weight_per_length)
    own = STIFF_ROD.weight_per_length * length
    name = f"clamped over two segments, {segments} segments"
    return [
        relative_check(
            f"tip drop, {name}",
            -shape.positions([free])[0, 1],
            -rod.points()[0, -1, 2],
            "m",
            refined(DROP_TOLERANCE, segments),
        ),
        relative_check(f"force of the first grip, {name}", own, -rod.wrench(0)[0][2], "N", 1e-6),
        relative_check(
            f"force of the second grip, {name}",
            STIFF_ROD.weight_per_length * STIFF_ROD.length - own,
            -rod.wrench(1)[0][2],
            "N",
            WEIGHT_TOLERANCE,
        ),
    ]
