"""Masses that a rod carries: on a rope, at a cantilever's tip, at the end of a pendulum."""

import numpy as np

from deformable_manipulation.validation.references.bent_cantilever import BentCantilever
from deformable_manipulation.validation.references.loaded_chain import LoadedChain
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
    GRAVITY,
    ROPE,
    RodProperties,
    hang,
    joint_arc_lengths,
    make_rod,
    pitched,
    settle,
)

TITLE = "Mass at points"
METHOD = """*Chain*: a limp rope (E 10 kPa) of the paper's sizes, pinned 1.5 m apart, carries
0.1 kg, two thirds of its own mass, at a joint, two sevenths of its length from one end. Theory:
two catenaries. *Cantilever*: a rod of 1 m (E 3 GPa) with a plug of 0.05 kg at its tip. Theory:
the elastica with a weight at its end. *Pendulum*: a stiff rod (E 3 TPa) of 1 m, pinned at its
first segment, with a plug of 0.2 kg at its free end, swings by 1 mm without damping. Theory:
the period of a rigid pendulum."""
GRIP = (1.5, 0.0)
CHAIN = (ROPE.length * 2.0 / 7.0, 0.1)  # m, kg
PLUG = 0.05  # kg, at the cantilever's tip
BOB = 0.2  # kg, at the pendulum's end
ROD = RodProperties(1.0, young_modulus=3e9, torsion_modulus=1e9)
SEGMENTS = (28, 56, 112)
TOLERANCE = {"chain": 0.04, "cantilever": 0.05}  # % at 28 segments
FORCE_TOLERANCE = 0.2  # % at 28 segments
PERIOD_TOLERANCE = 0.1  # %


def run(quick: bool = False) -> CaseResult:
    """All rods; quick: 28 segments."""
    checks, panels = [], []
    chosen = SEGMENTS[:1] if quick else SEGMENTS
    for name, compare in {"chain": _chain, "cantilever": _cantilever}.items():
        curves = []
        for segments in chosen:
            measured, truth, length, more = compare(segments)
            away = percent_of(measured - truth, length)
            quantity = f"largest deviation / L, {name}, {segments} segments"
            checks += [error_check(quantity, away, "%", refined(TOLERANCE[name], segments)), *more]
            curves.append(Curve(f"{segments}: {away:.3f} %", measured[:, 0], measured[:, 1]))
        theory = Curve("theory", truth[:, 0], truth[:, 1], theory=True)
        panels.append(Panel(name, "x [m]", "z [m]", [theory, *curves], equal=True))
    return CaseResult(TITLE, METHOD, [*checks, *map(_pendulum, chosen)], panels)


def _chain(segments):
    limp = ROPE.with_young_modulus(1e4)
    at, mass = CHAIN
    rod = hang(limp, segments, GRIP, "pinned", point_masses=[(at, mass)])
    half = 0.5 * ROPE.length / segments
    chain = LoadedChain(
        ROPE.length - 2.0 * half, *GRIP, limp.weight_per_length, at - half, mass * GRAVITY
    )
    measured = rod.points()[0, 1:-1, ::2]
    truth = chain.positions(joint_arc_lengths(limp, segments))
    pull = chain.forces()[0]
    force = relative_check(
        f"horizontal tension, chain, {segments} segments",
        pull,
        rod.wrench(0)[0][0],
        "N",
        refined(FORCE_TOLERANCE, segments),
    )
    weight = limp.weight_per_length * limp.length + mass * GRAVITY
    sum_of = -(rod.wrench(0)[0] + rod.wrench(segments - 1)[0])[2]
    total = relative_check(
        f"sum of reactions, chain, {segments} segments", weight, sum_of, "N", 0.1
    )
    return measured, truth, limp.length, [force, total]


def _cantilever(segments):
    rod = make_rod(ROD, segments, point_masses=[(ROD.length, PLUG)])
    rod.hold(0, "clamped", (0.0, 0.0, 0.0), pitched(0.0))
    rod.lay_out()
    settle(rod)
    truth = BentCantilever(
        ROD.length * (segments - 0.5) / segments,
        ROD.bending_stiffness,
        ROD.weight_per_length,
        tip_weight=PLUG * GRAVITY,
    )
    measured = rod.points()[0, 1:-1, ::2]
    return measured, truth.positions(joint_arc_lengths(ROD, segments)), ROD.length, []


def _pendulum(segments):
    """The period [s], from the times at which the end passes the middle."""
    stiff = ROD.with_young_modulus(3e12)
    rod = make_rod(stiff, segments, damping=0.0, point_masses=[(ROD.length, BOB)])
    below = 0.5 * ROD.length / segments
    reach = ROD.length - below
    swing = 1e-3  # m, of the end
    ends = ROD.length * np.linspace(0.0, 1.0, segments + 1) - below
    points = np.stack([ends * swing / reach, 0.0 * ends, -ends], axis=1)
    rod.hold(0, "pinned", (0.0, 0.0, 0.0), pitched(-0.5 * np.pi))
    rod.set_state(points, np.zeros_like(points))
    step, crossings, before = 1e-3, [], swing
    for count in range(1, 4000):
        rod.step(step, 1)
        now = rod.points()[0, -1, 0]
        if before > 0.0 >= now or before < 0.0 <= now:
            crossings.append(step * (count - 1 + before / (before - now)))
        before = now
    period = 2.0 * float(np.mean(np.diff(crossings)))
    mass = ROD.mass_per_length * ROD.length
    inertia = mass * (ROD.length**2 / 12.0 + (0.5 * ROD.length - below) ** 2) + BOB * reach**2
    moment = GRAVITY * (mass * (0.5 * ROD.length - below) + BOB * reach)
    truth = 2.0 * np.pi * np.sqrt(inertia / moment)
    quantity = f"period of the pendulum, {segments} segments"
    return relative_check(quantity, truth, period, "s", PERIOD_TOLERANCE)
