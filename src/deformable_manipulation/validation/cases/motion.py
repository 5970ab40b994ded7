"""Motion in time: ring-down, swing, and a rod carried steadily."""

from dataclasses import replace

import numpy as np
from scipy.optimize import curve_fit

from deformable_manipulation.validation.references.swing import SwingingRod
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
    pitched,
)

TITLE = "Damping and time"
METHOD = """Damping removes c times the velocity per second, so an oscillation decays at c / 2.
The integration, implicit Euler, adds omega^2 h / 2 with the substep h. Lengths are chosen to
give a free length of 2.2 m for every number of segments. *Ring-down*: a clamped rod of E 30 GPa
with c = 0.5 /s is released from straight under 0.02 m/s^2. A damped cosine is fitted to its
projection on the first mode. Theory: the frequency 1.8751^2 sqrt(E I / (rho A L^4)) of a clamped
beam, with damping, and the decay c / 2 + omega^2 h / 2. *Swing*: the rope is pinned at its end
and released from straight, 0.5 rad from the vertical, with c = 0.5 /s. Theory: the motion of the
continuous rope by Galerkin's method. The error is the largest distance of the free end over 3 s,
over the length. It comes from the time step: it is the same for all numbers of segments and
proportional to h. With so little damping, one substep of 10 ms is at the limit of the direct
solver (the joints of 24 to 30 segments open by some percent), so the swing is compared from two
substeps on. *Carried*: the rope held at both ends, 1.5 m apart, is carried at 0.1 m/s along,
across and up with the default damping. The error is the largest distance from its shape at rest
after 5 s."""
FREE_LENGTH = 2.2  # m
DAMPING = 0.5  # 1/s
SEGMENTS = (28, 45, 100)
SUBSTEPS = (1, 2, 5, 10)
SWING_SUBSTEPS = (2, 5, 10)
RING_GRAVITY = 0.02  # m/s^2
RING_TIME = 8.0  # s
FREQUENCY_TOLERANCE = 0.2  # %
DECAY_TOLERANCE = 1.0  # %
SWING_ANGLE = 0.5  # rad
SWING_TIME = 3.0  # s
SWING_TOLERANCE = 5.0  # % of the length per 10 ms of a substep
RESOLUTION_TOLERANCE = 0.2  # % of the length
CARRY_SPEED = 0.1  # m/s
CARRY_TIME = 5.0  # s
CARRY_TOLERANCE = 1.0  # mm


def run(quick: bool = False) -> CaseResult:
    """Ring, swing and carry; quick: 28 segments, 2 substeps."""
    counts = SEGMENTS[:1] if quick else SEGMENTS
    ringing, ring_panel = _ring_downs(counts, (2,) if quick else SUBSTEPS)
    swinging, swing_panel = _swings(counts, (2,) if quick else SWING_SUBSTEPS)
    carried = [_carry(n, hold) for n in counts for hold in ("pinned", "clamped")]
    return CaseResult(TITLE, METHOD, [*ringing, *swinging, *carried], [ring_panel, swing_panel])


def _of_free_length(properties, segments):
    return replace(properties, length=FREE_LENGTH / (1.0 - 0.5 / segments))


def _ring_downs(counts, substep_counts):
    checks, curves = [], []
    mode = first_mode(FREE_LENGTH, STIFF_ROD.bending_stiffness, STIFF_ROD.mass_per_length)
    for segments in counts:
        errors = []
        for substeps in substep_counts:
            frequency, decay = _ring(mode, segments, substeps)
            name = f"{segments} segments, {substeps} substeps"
            expected = 0.5 * (DAMPING + mode.frequency**2 * TIME_STEP / substeps)
            pair = [
                relative_check(
                    f"frequency of the ring-down, {name}",
                    np.sqrt(mode.frequency**2 - 0.25 * DAMPING**2),
                    frequency,
                    "rad/s",
                    FREQUENCY_TOLERANCE,
                ),
                relative_check(
                    f"decay of the ring-down, {name}", expected, decay, "1/s", DECAY_TOLERANCE
                ),
            ]
            checks += pair
            errors.append(max(pair[0].error, 1e-4))
        label = f"{segments}: {max(errors):.2g} % (at most {FREQUENCY_TOLERANCE:g} %)"
        curves.append(Curve(label, substep_counts, errors))
    title = "ring-down: error of the frequency"
    axes = {"x_scale": "log", "y_scale": "log", "limit": FREQUENCY_TOLERANCE}
    return checks, Panel(title, "substeps per 10 ms", "%", curves, **axes)


def _ring(mode, segments, substeps):
    """Fitted frequency [rad/s] and decay [1/s]."""
    properties = _of_free_length(STIFF_ROD, segments)
    rod = make_rod(properties, segments, gravity=(0.0, 0.0, -RING_GRAVITY), damping=DAMPING)
    rod.hold(0)
    shape = mode.shape(grip_arc_lengths(properties, segments) / FREE_LENGTH)
    times = TIME_STEP * np.arange(int(RING_TIME / TIME_STEP))
    amplitudes = []
    for _ in times:
        amplitudes.append(rod.positions()[:, 2] @ shape / (shape @ shape))
        rod.step(TIME_STEP, substeps)

    def damped(t, a, b, frequency, decay, rest):
        wave = a * np.cos(frequency * t) + b * np.sin(frequency * t)
        return np.exp(-decay * t) * wave + rest

    rest = np.mean(amplitudes)
    guess = [-rest, 0.0, mode.frequency, 0.5 * DAMPING, rest]
    fitted, _ = curve_fit(damped, times, amplitudes, p0=guess)
    return fitted[2], fitted[3]


def _swings(counts, substep_counts):
    times = TIME_STEP * np.arange(int(SWING_TIME / TIME_STEP) + 1)
    rod = SwingingRod(FREE_LENGTH, ROPE.bending_stiffness, ROPE.mass_per_length, GRAVITY, DAMPING)
    truth = rod.swing(SWING_ANGLE, times, np.array([FREE_LENGTH]))[:, 0]
    checks, curves = [], [Curve("theory", times, truth[:, 0], theory=True)]
    for substeps in substep_counts:
        ends = {n: _swing(n, substeps, times) for n in counts}
        for segments, end in ends.items():
            error = 100.0 * np.linalg.norm(end - truth, axis=1).max() / FREE_LENGTH
            name = f"{segments} segments, {substeps} substeps"
            tolerance = SWING_TOLERANCE / substeps
            checks.append(error_check(f"largest error of the swing, {name}", error, "%", tolerance))
        if len(counts) > 1:
            checks.append(_resolution(ends, substeps))
        label = f"{substeps} substeps: {error:.2g} % (at most {tolerance:.2g} %)"
        curves.append(Curve(label, times[::5], end[::5, 0]))
    title = "swing of the free end, {} segments".format(counts[-1])
    return checks, Panel(title, "t [s]", "x [m]", curves)


def _swing(segments, substeps, times):
    """Path (T, 2) of the free end, x and z [m]."""
    properties = _of_free_length(ROPE, segments)
    along = np.array([np.sin(SWING_ANGLE), 0.0, -np.cos(SWING_ANGLE)])
    rod = make_rod(
        properties,
        segments,
        damping=DAMPING,
        position=-0.5 * properties.length / segments * along,
        orientation=pitched(SWING_ANGLE - 0.5 * np.pi),
    )
    rod.hold(0, "pinned")
    path = []
    for _ in times:
        path.append(rod.points()[0, -1, ::2])
        rod.step(TIME_STEP, substeps)
    return np.array(path)


def _resolution(ends, substeps) -> Check:
    finest = ends[max(ends)]
    apart = max(np.linalg.norm(end - finest, axis=1).max() for end in ends.values())
    return error_check(
        f"swing, spread over {min(ends)} to {max(ends)} segments, {substeps} substeps",
        100.0 * apart / FREE_LENGTH,
        "%",
        RESOLUTION_TOLERANCE,
    )


def _carry(segments, hold) -> Check:
    rod = hang(ROPE, segments, (1.5, 0.0), hold)
    at_rest = rod.points()[0]
    worst = 0.0
    for direction in np.eye(3):
        carried = rod.clone()
        for particle in (0, segments - 1):
            carried.set_velocity(particle, CARRY_SPEED * direction)
        for _ in range(int(CARRY_TIME / TIME_STEP)):
            carried.step(TIME_STEP, 2)
        moved = carried.points()[0] - CARRY_SPEED * CARRY_TIME * direction
        worst = max(worst, np.linalg.norm(moved - at_rest, axis=1).max())
    quantity = f"carried at 0.1 m/s, {hold}, {segments} segments"
    return error_check(quantity, 1000.0 * worst, "mm", CARRY_TOLERANCE)
