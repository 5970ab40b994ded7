"""Reactions at rest: force and torque at both ends."""

import numpy as np

from deformable_manipulation.validation.cases import spatial
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
)
from deformable_manipulation.validation.rod import (
    ROPE,
    STIFF_ROD,
    hang,
    make_rod,
    settle,
)

TITLE = "Wrenches at rest"
METHOD = """Force and torque (about the centre of the grip) on the grips of rods at rest: a
clamped rope (E 30 MPa), level and not level, the cantilever of E 30 GPa, and the rods of E 30
MPa and 3 GPa with one end moved out of the plane and turned. *Against statics*: the wrenches
must balance the weights of the simulated segments at any resolution. *Against theory*: the ends
of the elastica and of the Kirchhoff rod, with the weight of the half segments beyond the grips.
Errors are norms. Those of forces are over the largest of weight and force, those of torques over
the largest torque. The rope bends within 0.1 m of its clamps, which is about one segment of 28.
This explains the tolerance of its torque."""
SEGMENTS = (28, 45, 100)
BALANCE_TOLERANCE = 5e-4  # %, the gaps that zero stretch leaves in the joints are levers
# Percent at 28 segments: force, torque.
TOLERANCES = {
    "rope, level": (0.12, 5.0),
    "rope, not level": (0.14, 4.0),
    "cantilever": (1e-5, 1e-3),
    "rope in space": (0.7, 28.0),
    "E 3 GPa in space": (1.0, 1.5),
}
QUICK = ("rope, level", "cantilever")


def run(quick: bool = False) -> CaseResult:
    """Compare the wrenches of five rods; quick: two, with 28 segments."""
    counts = SEGMENTS[:1] if quick else SEGMENTS
    checks, forces, torques = [], [], []
    for name in QUICK if quick else TOLERANCES:
        errors = []
        for segments in counts:
            rod, grips, expected = _solutions(name, segments)
            measured = np.array([np.concatenate(rod.wrench(grip)) for grip in grips])
            case = f"{name}, {segments} segments"
            checks += [
                _balance(case, rod, grips, measured, segments),
                *_theory(case, measured, expected, TOLERANCES[name], segments),
            ]
            errors.append([max(check.error, 1e-9) for check in checks[-2:]])
        for curves, column, limit in zip((forces, torques), np.transpose(errors), TOLERANCES[name]):
            label = f"{name}: {column[0]:.2g} % (at most {limit:g} %)"
            curves.append(Curve(label, counts, column))
    panels = [
        Panel(f"{title}, legend: at 28", "segments", "error [%]", curves, "log", "log")
        for title, curves in (("force", forces), ("torque", torques))
    ]
    return CaseResult(TITLE, METHOD, checks, panels)


def _solutions(name, segments):
    """Simulated rod, held particles, and the wrenches (A, 6) that theory has on them."""
    both = [0, segments - 1]
    if name == "cantilever":
        rod = make_rod(STIFF_ROD, segments)
        rod.hold(0)
        settle(rod)
        free = STIFF_ROD.length * (1.0 - 0.5 / segments)
        weight = STIFF_ROD.weight_per_length
        shape = solve_cantilever(free, STIFF_ROD.bending_stiffness, weight)
        return rod, both[:1], _planar(shape, STIFF_ROD, segments)[:1]
    if name.endswith("space"):
        properties = ROPE.with_young_modulus(3e9 if name.startswith("E 3 GPa") else 30e6)
        theory = spatial.follow(properties, segments)
        expected = _end_wrenches(theory.forces, theory.moments, theory.length)
        expected[:, 2] -= 0.5 * properties.weight_per_length * properties.length / segments
        return spatial.simulate(properties, segments), both, expected
    chord = (1.5, 0.0) if name == "rope, level" else (1.3, 0.6)
    length = ROPE.length * (segments - 1) / segments
    material = ROPE.bending_stiffness, ROPE.weight_per_length
    shape = solve_between(length, *material, chord, Clamped(), Clamped())
    return hang(ROPE, segments, chord, "clamped"), both, _planar(shape, ROPE, segments)


def _planar(shape, properties, segments):
    def forces(arcs):
        x, z = shape.forces(arcs).T
        return np.stack([x, np.zeros_like(x), z], axis=-1)

    def moments(arcs):
        across = -shape.moments(arcs)  # from x towards z is against the y axis
        return np.stack([np.zeros_like(across), across, np.zeros_like(across)], axis=-1)

    wrenches = _end_wrenches(forces, moments, shape.length)
    half = 0.5 * properties.length / segments
    load = properties.weight_per_length * half
    wrenches[:, 2] -= load
    # The half segments beyond the grips, which are level, lie to both sides.
    wrenches[0, 4] -= 0.5 * half * load
    wrenches[1, 4] += 0.5 * half * load
    return wrenches


def _end_wrenches(forces, moments, length):
    first = np.concatenate([forces([0.0])[0], moments([0.0])[0]])
    last = np.concatenate([forces([length])[0], moments([length])[0]])
    return np.array([first, -last])


def _balance(case, rod, grips, wrenches, segments):
    positions = rod.positions()
    weight = np.array([0.0, 0.0, -ROPE.weight_per_length * ROPE.length])
    force = wrenches[:, :3].sum(axis=0) - weight
    torque = wrenches[:, 3:].sum(axis=0) - np.cross(positions, weight / segments).sum(axis=0)
    torque += np.cross(positions[grips], wrenches[:, :3]).sum(axis=0)
    total = -weight[2]
    worst = 100.0 * max(np.linalg.norm(force), np.linalg.norm(torque) / ROPE.length) / total
    return error_check(f"balance / weight, {case}", worst, "%", BALANCE_TOLERANCE)


def _theory(case, measured, expected, tolerances, segments):
    away = np.linalg.norm((measured - expected).reshape(-1, 2, 3), axis=2).max(axis=0)
    size = np.linalg.norm(expected.reshape(-1, 2, 3), axis=2).max(axis=0)
    size[0] = max(size[0], ROPE.weight_per_length * ROPE.length)
    return [
        error_check(f"{quantity}, {case}", 100.0 * error / scale, "%", refined(limit, segments))
        for quantity, error, scale, limit in zip(("force", "torque"), away, size, tolerances)
    ]
