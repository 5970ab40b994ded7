"""Material damping and drag: how soon modes decay, and how fast a rod falls; rest stays."""

from dataclasses import replace
from typing import List, Tuple

import numpy as np
from scipy.optimize import curve_fit

from deformable_manipulation.validation.references.vibration import first_mode
from deformable_manipulation.validation.result import (
    CaseResult,
    Check,
    Curve,
    Panel,
    error_check,
    relative_check,
)
from deformable_manipulation.validation.rod import (
    GRAVITY,
    ROPE,
    STIFF_ROD,
    TIME_STEP,
    grip_arc_lengths,
    hang,
    make_rod,
    move,
    settle,
)

TITLE = "Viscous joints and drag"
METHOD = """The joints alone damp, by a torque of tau (the retardation time) times the stiffness
times the rate of bending or twist: a Kelvin-Voigt material. A mode of angular frequency omega
then decays at omega^2 tau / 2. Implicit Euler with the substep h adds omega^2 h / 2. Rods with a
free length of 2.2 m ring out, and a damped cosine is fitted. *Clamped*: the stiff rod, clamped
at one end, released from straight under 0.02 m/s^2. Theory: omega = 1.8751^2 sqrt(E I / (rho A
L^4)). *Twisted*: the rope without gravity, clamped at one end and released from 0.5 rad of
twist. Theory: omega = pi / (2 L) sqrt(G / rho). The Gauss-Seidel solver is compared on the rope,
whose clamped end swings once in 38 s. *Rest*: the rope at rest, 1.5 m between clamps, becomes
viscous. It should not move. *Drag*: the rope, level and held nowhere, falls through still air
with the drag coefficient 1.2. Theory: v = v_t tanh(g t / v_t), v_t^2 = pi r rho g / (1.2
rho_air)."""
FREE_LENGTH = 2.2  # m
BENDING_TIMES = (0.02, 0.1)  # s
TORSION_TIME = 1e-3  # s
SEGMENTS = (28, 100)
SUBSTEPS = (2, 10)
TWIST_SUBSTEPS = 20
SWEEPS = 50
PERIODS = 7
FREQUENCY_TOLERANCE = 0.5  # %
DECAY_TOLERANCE = 2.0  # %
REST_TOLERANCE = 0.05  # mm
TWIST = 0.5  # rad
AIR_DENSITY = 1.2  # kg/m^3
DRAG_COEFFICIENT = 1.2
FALL_TIME = 2.0  # s
FALL_TOLERANCE = 0.1  # %


def run(quick: bool = False) -> CaseResult:
    """Ring out in all ways; quick: 28 segments."""
    checks: List[Check] = []
    curves = [Curve("theory, with implicit Euler", (0.0, 2.5), (0.0, 2.5), theory=True)]
    for segments in SEGMENTS[:1] if quick else SEGMENTS:
        for time in BENDING_TIMES:
            for substeps in SUBSTEPS:
                case = f"clamped, tau {time:g} s, {segments} segments, {substeps} substeps"
                rung = _clamped(segments, substeps, time)
                checks += _compare(case, TIME_STEP / substeps, time, *rung)
        case = f"twisted, tau {TORSION_TIME:g} s, {segments} segments, {TWIST_SUBSTEPS} substeps"
        rung = _twisted(segments, TWIST_SUBSTEPS, TORSION_TIME)
        checks += _compare(case, TIME_STEP / TWIST_SUBSTEPS, TORSION_TIME, *rung)
    case = f"clamped, Gauss-Seidel, tau 0.1 s, {SEGMENTS[0]} segments, {SWEEPS} substeps"
    checks += _compare(case, TIME_STEP / SWEEPS, 0.1, *_swept(SEGMENTS[0], SWEEPS, 0.1))
    checks += [_rest("direct", 2), _rest("gauss_seidel", SWEEPS)]
    checks += [_fall(solver) for solver in ("direct", "gauss_seidel")]
    for kind in ("clamped", "twisted"):
        of_kind = [c for c in checks if c.quantity.startswith(f"decay, {kind}")]
        curves.append(
            Curve(kind, [c.theory or 0.0 for c in of_kind], [c.measured for c in of_kind])
        )
    return CaseResult(
        TITLE, METHOD, checks, [Panel("decay", "theory [1/s]", "measured [1/s]", curves)]
    )


def _compare(case, substep, time, natural, frequency, decay) -> List[Check]:
    """Both numbers [1/s] against those of a mode of a natural frequency [rad/s]."""
    expected = 0.5 * natural**2 * (time + substep)
    ringing = np.sqrt(natural**2 - expected**2)
    return [
        relative_check(f"frequency, {case}", ringing, frequency, "rad/s", FREQUENCY_TOLERANCE),
        relative_check(f"decay, {case}", expected, decay, "1/s", DECAY_TOLERANCE),
    ]


def _of_free_length(properties, segments):
    return replace(properties, length=FREE_LENGTH / (1.0 - 0.5 / segments))


def _ring(rod, amplitude, natural, substeps, guess) -> Tuple[float, float, float]:
    """Natural frequency, fitted frequency [rad/s] and decay [1/s] of an amplitude over time."""
    times = TIME_STEP * np.arange(int(PERIODS * 2.0 * np.pi / natural / TIME_STEP))
    amplitudes = []
    for _ in times:
        amplitudes.append(amplitude())
        rod.step(TIME_STEP, substeps)

    def damped(t, a, b, frequency, decay, rest):
        wave = a * np.cos(frequency * t) + b * np.sin(frequency * t)
        return np.exp(-decay * t) * wave + rest

    rest = amplitudes[-1]
    start = [amplitudes[0] - rest, 0.0, natural, guess, rest]
    fitted, _ = curve_fit(damped, times, amplitudes, p0=start)
    return natural, abs(fitted[2]), fitted[3]


def _clamped(segments, substeps, time, properties=STIFF_ROD, gravity=0.02, solver="direct"):
    mode = first_mode(FREE_LENGTH, properties.bending_stiffness, properties.mass_per_length)
    rod = make_rod(
        _of_free_length(properties, segments),
        segments,
        gravity=(0.0, 0.0, -gravity),
        damping=0.0,
        bending_retardation_time=time,
        solver=solver,
    )
    rod.hold(0)
    arcs = grip_arc_lengths(_of_free_length(properties, segments), segments)
    shape = mode.shape(arcs / FREE_LENGTH)
    guess = 0.5 * mode.frequency**2 * (time + TIME_STEP / substeps)
    return _ring(rod, lambda: rod.positions()[:, 2] @ shape, mode.frequency, substeps, guess)


def _swept(segments, substeps, time):
    return _clamped(segments, substeps, time, ROPE, 1e-4, "gauss_seidel")


def _twisted(segments, substeps, time):
    natural = 0.5 * np.pi / FREE_LENGTH * np.sqrt(ROPE.torsion_modulus / ROPE.density)
    properties = _of_free_length(ROPE, segments)
    rod = make_rod(
        properties, segments, gravity=(0, 0, 0), damping=0.0, torsion_retardation_time=time
    )
    rod.hold(0)
    rod.hold(segments - 1)
    move(rod, segments - 1, (0.0, 0.0, 0.0), (TWIST, 0.0, 0.0), 1.0)
    settle(rod)
    rod.release(segments - 1)
    shape = np.sin(0.5 * np.pi * grip_arc_lengths(properties, segments) / FREE_LENGTH)

    def amplitude():
        orientations = rod.orientations()
        return 2.0 * np.arctan2(orientations[:, 0], orientations[:, 3]) @ shape

    guess = 0.5 * natural**2 * (time + TIME_STEP / substeps)
    return _ring(rod, amplitude, natural, substeps, guess)


def _fall(solver) -> Check:
    drag = AIR_DENSITY * DRAG_COEFFICIENT / (np.pi * ROPE.density * ROPE.radius)  # 1/m
    rod = make_rod(ROPE, SEGMENTS[0], damping=0.0, drag_coefficient=DRAG_COEFFICIENT, solver=solver)
    for _ in range(int(FALL_TIME / TIME_STEP)):
        rod.step(TIME_STEP, 10)
    final = np.sqrt(GRAVITY / drag)
    theory = final * np.tanh(GRAVITY * FALL_TIME / final)
    measured = -rod.velocities()[:, 2].mean()
    return relative_check(
        f"speed after {FALL_TIME:g} s, {solver}", theory, measured, "m/s", FALL_TOLERANCE
    )


def _rest(solver, substeps) -> Check:
    """How far the rope at rest is moved by becoming viscous."""
    rod = hang(ROPE, SEGMENTS[0], (1.5, 0.0), "clamped", solver=solver)
    settle(rod, substeps, speed=1e-7)
    before = rod.points()[0]
    rod.set_material({"bending_retardation_time": 0.1, "torsion_retardation_time": 0.1})
    for _ in range(300):
        rod.step(TIME_STEP, substeps)
    moved = 1000.0 * np.linalg.norm(rod.points()[0] - before, axis=1).max()
    return error_check(f"rest, {solver}, {substeps} substeps", moved, "mm", REST_TOLERANCE)
