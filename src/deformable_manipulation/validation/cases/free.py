"""A rod that nobody holds: free fall and momentum."""

import numpy as np
from scipy.spatial.transform import Rotation

from deformable_manipulation.validation.result import (
    CaseResult,
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
    make_rod,
)

TITLE = "Free rod"
METHOD = """*Fall*: a rope that is held nowhere falls for 1 s with the default damping of 10 /s.
Damping acts on motion relative to the rod's own rigid motion and must not slow the fall. Theory:
g t and g t^2 / 2. The integration (implicit Euler) is of first order and gives a path of g t (t
+ h) / 2 with the substep h, so the tolerance of the path is 1.1 h / t. *Flight*: the stiff rod,
without gravity, is held at a quarter of its length, moved and spun up to 2 rad/s, and released.
It flies for 3 s. Its linear momentum and its angular momentum about the fixed origin must not
change, damped or not. Implicit Euler removes omega^2 h / 2 per second from a rotation omega. The
tolerance of the angular momentum is 1.5 times that; the tolerance of the linear momentum is
rounding. The error is the norm of the change over the norm."""
SUBSTEPS = (1, 2, 10)
FALL_TIME = 1.0  # s
FLIGHT_TIME = 3.0  # s
SPEED_TOLERANCE = 1e-6  # %
MOMENTUM_TOLERANCE = 1e-6  # %
VELOCITY = np.array([0.1, 0.2, 0.0])  # m/s
SPIN = np.array([0.0, 0.0, 2.0])  # rad/s
SPIN_UP = 2.0  # s
SEGMENTS = 28


def run(quick: bool = False) -> CaseResult:
    """Let rods fall and fly; quick: for 2 substeps alone."""
    counts = (2,) if quick else SUBSTEPS
    checks, falls, flights = [], [], []
    for substeps in counts:
        checks += _fall(substeps, falls)
    for damping in (0.0, 10.0):
        for substeps in counts:
            checks += _fly(substeps, damping, flights)
    panels = [
        Panel("fall: error of the path", "t [s]", "%", falls, y_scale="log"),
        Panel("flight: change of the angular momentum", "t [s]", "%", flights),
    ]
    return CaseResult(TITLE, METHOD, checks, panels)


def _fall(substeps, curves):
    rod = make_rod(ROPE, SEGMENTS)
    times, depths = [], []
    for step in range(1, int(round(FALL_TIME / TIME_STEP)) + 1):
        rod.step(TIME_STEP, substeps)
        times.append(step * TIME_STEP)
        depths.append(-rod.positions()[:, 2].mean())
    path = 0.5 * GRAVITY * np.array(times) ** 2
    tolerance = 100.0 * 1.1 * TIME_STEP / substeps / FALL_TIME
    name = f"{substeps} substeps"
    checks = [
        relative_check(
            f"speed after {FALL_TIME:g} s of free fall, {name}",
            GRAVITY * FALL_TIME,
            -rod.velocities()[:, 2].mean(),
            "m/s",
            SPEED_TOLERANCE,
        ),
        relative_check(
            f"path after {FALL_TIME:g} s of free fall, {name}",
            path[-1],
            depths[-1],
            "m",
            tolerance,
        ),
    ]
    errors = 100.0 * np.abs(np.array(depths) / path - 1.0)
    label = f"{name}: {errors[-1]:.2f} % at the end (at most {tolerance:.2g} %)"
    curves.append(Curve(label, times, errors))
    return checks


def _fly(substeps, damping, curves):
    rod = make_rod(STIFF_ROD, SEGMENTS, gravity=(0.0, 0.0, 0.0), damping=damping)
    held = SEGMENTS // 4
    rod.hold(held)
    for gain in _smooth_rise(int(round(SPIN_UP / TIME_STEP))):
        rod.set_velocity(held, gain * VELOCITY, gain * SPIN)
        rod.step(TIME_STEP, substeps)
    rod.release(held)
    linear, angular = _step_momenta(rod, substeps)
    times = TIME_STEP * np.arange(1, int(round(FLIGHT_TIME / TIME_STEP)) + 1)
    changes = []
    for _ in times:
        now = _step_momenta(rod, substeps)
        changes.append(100.0 * np.linalg.norm(now[1] - angular) / np.linalg.norm(angular))
    drift = 100.0 * np.linalg.norm(now[0] - linear) / np.linalg.norm(linear)
    name = f"after {FLIGHT_TIME:g} s, damping {damping:g} /s, {substeps} substeps"
    tolerance = 100.0 * 1.5 * 0.5 * SPIN @ SPIN * TIME_STEP / substeps * FLIGHT_TIME
    label = f"{damping:g} /s, {substeps} substeps: {max(changes):.2g} % (at most {tolerance:.2g} %)"
    curves.append(Curve(label, times, changes))
    return [
        error_check(f"change of momentum {name}", drift, "%", MOMENTUM_TOLERANCE),
        error_check(f"change of angular momentum {name}", max(changes), "%", tolerance),
    ]


def _smooth_rise(steps):
    """From 0 to 1 without a jerk, so that the rod does not ring when it is let go."""
    return 0.5 - 0.5 * np.cos(np.pi * np.arange(1, steps + 1) / steps)


def _step_momenta(rod, substeps):
    """Take a step; returns momentum (3,) [N s] and angular momentum (3,) [N m s] at its end.

    The spin of the segments, a thousandth of the angular momentum, is the step's mean.
    """
    before = Rotation.from_quat(rod.orientations())
    rod.step(TIME_STEP, substeps)
    after = Rotation.from_quat(rod.orientations())
    spin = (after * before.inv()).as_rotvec() / TIME_STEP
    axes = after.apply([1.0, 0.0, 0.0])
    mass = rod.mass / SEGMENTS
    radius, length = STIFF_ROD.radius, STIFF_ROD.length / SEGMENTS
    across = mass * (3.0 * radius**2 + length**2) / 12.0
    along = 0.5 * mass * radius**2
    axial = np.sum(axes * spin, axis=1)[:, None] * axes
    momenta = mass * rod.velocities()
    angular = np.cross(rod.positions(), momenta) + across * (spin - axial) + along * axial
    return momenta.sum(axis=0), angular.sum(axis=0)
