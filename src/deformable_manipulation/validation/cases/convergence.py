"""Error over the number of segments and substeps, for both solvers, and the time to settle."""

import numpy as np

from deformable_manipulation.validation.references.elastica import (
    Clamped,
    solve_between,
    solve_cantilever,
)
from deformable_manipulation.validation.result import (
    CaseResult,
    Check,
    Curve,
    Panel,
    error_check,
    percent_of,
)
from deformable_manipulation.validation.rod import (
    ROPE,
    STIFF_ROD,
    TIME_STEP,
    joint_arc_lengths,
    make_rod,
    pitched,
    settle,
)

TITLE = "Convergence and settling"
METHOD = """*Error at rest* compares the rope, clamped level at a span of 1.5 m (largest
deviation / L), and the cantilever of E 30 GPa (tip drop) with the elastica. The fixed point of
the direct solver is the equilibrium of the segments. Its error must not depend on the number of
substeps (the table has the spread over 1 to 10 per 10 ms), and must fall with the square of the
segment length (the table has the order between 28 and 200 segments). Gauss-Seidel softens the
rod, more so with larger substeps and finer rods. It must reach the direct solver's error from 5
substeps on with 28 segments, and from 20 with 45. For the stiff rod it is shown without a
tolerance; this is why it is not the default.

*Settling* is the simulated time, and the number of substeps, from the first guess of the shape
(a straight line for the stiff cantilever) until all joints stay within 0.1 % of L of their final
places. The substep is 10 ms and the damping 10 /s."""
SEGMENTS = (28, 45, 100, 200)
SUBSTEPS = (1, 2, 5, 10)
GAUSS_SEIDEL_SUBSTEPS = (1, 2, 5, 10, 20)
SPREAD_TOLERANCE = 1e-3  # % of L or of the drop
ORDER_TOLERANCE = 0.15  # of the order 2
GAUSS_SEIDEL_ROPES = {28: (5, 10, 20), 45: (20,)}  # segments: substeps
TIMES_DIRECT = 1.1
ARRIVED = 1e-3  # of L
REST = 1e-7  # m/s
TIME_LIMIT = {"direct": 60.0, "gauss_seidel": 15.0}  # s
SETTLING = {"rope, both ends": 0.6, "stiff rod, both ends": 0.2, "stiff cantilever": 1.5}  # s
SPAN = 1.5  # m
LEAST_ERROR = 1e-4  # %, for logarithmic axes


def run(quick: bool = False) -> CaseResult:
    """Refine segments and substeps; quick: 28 and 100 segments, 1 and 10 substeps."""
    counts, substeps = ((28, 100), (1, 10)) if quick else (SEGMENTS, SUBSTEPS)
    checks, panels = [], []
    for name, error in (("rope", _rope_error), ("stiff cantilever", _cantilever_error)):
        errors = np.array([[error(n, "direct", sub) for sub in substeps] for n in counts])
        checks += _direct_checks(name, counts, errors)
        panels.append(_segments_panel(name, counts, errors))
    checks += _gauss_seidel_checks({28: (10,)} if quick else GAUSS_SEIDEL_ROPES)
    if not quick:
        panels += [
            _substeps_panel("rope", _rope_error),
            _substeps_panel("stiff cantilever", _cantilever_error),
        ]
    for name in SETTLING:
        checks += [_settling(name, n) for n in counts[:: len(counts) - 1]]
    return CaseResult(TITLE, METHOD, checks, panels)


def _start(name, segments, **options):
    """The rods before they settle."""
    rod = make_rod(ROPE if name.startswith("rope") else STIFF_ROD, segments, **options)
    rod.hold(0, "clamped", (0.0, 0.0, 0.0), pitched(0.0))
    if not name.endswith("cantilever"):
        rod.hold(segments - 1, "clamped", (SPAN, 0.0, 0.0), pitched(0.0))
        rod.lay_out()
    return rod


def _at_rest(name, segments, solver, substeps):
    """The rod at rest, or as it is after its time limit: Gauss-Seidel can go round forever."""
    rod = _start(name, segments, solver=solver)
    try:
        settle(rod, substeps, REST, TIME_LIMIT[solver])
    except RuntimeError:
        if solver == "direct":
            raise
    return rod


def _rope_error(segments, solver, substeps) -> float:
    rod = _at_rest("rope, both ends", segments, solver, substeps)
    length = ROPE.length * (segments - 1) / segments
    material = ROPE.bending_stiffness, ROPE.weight_per_length
    shape = solve_between(length, *material, (SPAN, 0.0), Clamped(), Clamped())
    truth = shape.positions(joint_arc_lengths(ROPE, segments))
    return percent_of(rod.points()[0, 1:-1, ::2] - truth, ROPE.length)


def _cantilever_error(segments, solver, substeps) -> float:
    rod = _at_rest("stiff cantilever", segments, solver, substeps)
    length = STIFF_ROD.length * (1.0 - 0.5 / segments)
    material = STIFF_ROD.bending_stiffness, STIFF_ROD.weight_per_length
    tip = solve_cantilever(length, *material).positions([length])[0, 1]
    return 100.0 * abs(rod.points()[0, -1, 2] / tip - 1.0)


def _direct_checks(name, counts, errors):
    spread = np.ptp(errors, axis=1).max()
    order = np.log(errors[0, -1] / errors[-1, -1]) / np.log(counts[-1] / counts[0])
    return [
        error_check(f"spread over substeps, direct, {name}", spread, "%", SPREAD_TOLERANCE),
        Check(
            quantity=f"order in the segment length, {name}",
            theory=2.0,
            measured=float(order),
            unit="",
            error=float(abs(order - 2.0)),
            tolerance=ORDER_TOLERANCE,
            error_unit="",
        ),
    ]


def _gauss_seidel_checks(ropes):
    checks = []
    for segments, counts in ropes.items():
        direct = _rope_error(segments, "direct", 2)
        for substeps in counts:
            error = _rope_error(segments, "gauss_seidel", substeps)
            name = f"Gauss-Seidel, rope of {segments} segments, {substeps} substeps"
            checks.append(
                Check(name, direct, error, "%", error / direct, TIMES_DIRECT, "times direct")
            )
    return checks


def _segments_panel(name, counts, errors):
    label = f"direct, within {np.ptp(errors, axis=1).max():.1g} % for all substeps"
    second_order = errors[0, -1] * (counts[0] / np.array(counts)) ** 2
    curves = [
        Curve("second order", counts, second_order, theory=True),
        Curve(label, counts, errors[:, -1]),
    ]
    return Panel(f"{name}: error over segments", "segments", "%", curves, "log", "log")


def _substeps_panel(name, error):
    curves = []
    for segments in SEGMENTS[:3]:
        direct = [error(segments, "direct", sub) for sub in (1, GAUSS_SEIDEL_SUBSTEPS[-1])]
        sweeps = [error(segments, "gauss_seidel", sub) for sub in GAUSS_SEIDEL_SUBSTEPS]
        ends = [1, GAUSS_SEIDEL_SUBSTEPS[-1]]
        curves += [
            Curve(
                f"{segments}, direct: {direct[-1]:.2g} %",
                ends,
                np.maximum(direct, LEAST_ERROR),
                theory=True,
            ),
            Curve(
                f"{segments}, Gauss-Seidel: {sweeps[-1]:.2g} % at last",
                GAUSS_SEIDEL_SUBSTEPS,
                sweeps,
            ),
        ]
    title = f"{name}: black direct (no slope), colour Gauss-Seidel"
    return Panel(title, "substeps per 10 ms", "%", curves, "log", "log")


def _settling(name, segments):
    rod = _start(name, segments)
    final = rod.clone()
    settle(final, 1, REST)
    goal = final.points()[0]
    arrived = 0
    for step in range(1, 2000):
        rod.step(TIME_STEP, 1)
        if np.linalg.norm(rod.points()[0] - goal, axis=1).max() > ARRIVED * ROPE.length:
            arrived = step + 1
        if step > 2 * arrived + 100:
            break
    quantity = f"settling of {name}, {segments} segments ({arrived} substeps of 10 ms)"
    return error_check(quantity, arrived * TIME_STEP, "s", SETTLING[name])
