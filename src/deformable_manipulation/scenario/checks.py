"""Checks of a scenario's sections against each other, for sections that are right by themselves."""

import math
from itertools import combinations, product
from typing import Sequence, Tuple

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import declared
from deformable_manipulation.reading.readers import Report, Slopes
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.barriers.pairs import limits_between
from deformable_manipulation.scenario.grip_points import held_points
from deformable_manipulation.scenario.spec import (
    LEADER,
    AgentSpec,
    ControllerSpec,
    LeaderSpec,
    SimulationSpec,
)

_WEIGHT_RATIO = 1e-2
_TIME_TOLERANCE = 1e-6  # relative; a time step is typed with a few digits
_LENGTH_TOLERANCE = 1e-9  # relative; starts on the undeformed object are a free length apart


def _exceeds(length: float, bound: float) -> bool:
    """Whether a length is beyond a bound by more than rounding."""
    return length > bound * (1.0 + _LENGTH_TOLERANCE)


def _distance(first: Sequence[float], second: Sequence[float]) -> float:
    return math.sqrt(math.fsum((a - b) ** 2 for a, b in zip(first, second)))


def check_loop(report: Report, controller: ControllerSpec) -> None:
    """Rates of convergence that the controller's cycle can follow, and a timeout it can meet."""
    rate = controller.rate
    for path, values in [*_slopes(controller), (("gain",), (controller.gain,))]:
        if max(values) >= rate:
            report.add(
                ("controller",) + path,
                "must be below controller.rate ({:g} Hz), or it overshoots within a cycle; lower "
                "it or raise the rate".format(rate),
                show(list(values) if len(values) > 1 else values[0]),
            )
    for path, weights in (
        (("weights",), controller.weights),
        (("horizon", "weights"), controller.horizon.weights),
    ):
        if min(weights) < _WEIGHT_RATIO * max(weights):
            report.add(
                ("controller",) + path,
                "must not be more than a factor of {:g} apart, or the quadratic program cannot be "
                "solved reliably".format(1.0 / _WEIGHT_RATIO),
                show(list(weights)),
            )
    if controller.timeout * rate < 1.0:
        report.add(
            ("controller", "timeout"),
            "must be at least one cycle, 1 / controller.rate = {:g} s".format(1.0 / rate),
            show(controller.timeout),
        )


def _slopes(controller: ControllerSpec):
    """Key path and value of every slope of the barriers in use."""
    for name in controller.barriers:
        section = getattr(controller, name)
        for key, (attribute, declaration) in declared(section).items():
            if isinstance(declaration.reader, Slopes):
                yield (name, key), getattr(section, attribute)


def check_barriers(
    report: Report, spec, agents: Tuple[AgentSpec, ...], controller: ControllerSpec
) -> None:
    """What each barrier in use demands of the object and the agents."""
    for name in controller.barriers:
        BARRIERS[name].check(report, spec, agents, controller)


def check_time(report: Report, controller: ControllerSpec, simulation: SimulationSpec) -> None:
    """Time steps, cycles, frames and duration fit each other."""
    cycle = 1.0 / controller.rate
    steps = cycle / simulation.time_step
    if abs(steps - round(steps)) > _TIME_TOLERANCE * steps or round(steps) < 1:
        counts = sorted({max(1, math.floor(steps)), max(1, math.ceil(steps))}, reverse=True)
        report.add(
            ("simulation", "time_step"),
            "a controller cycle (1 / controller.rate = {:g} s) must be a whole number of time "
            "steps; nearest: {}".format(
                cycle, " or ".join("{:.9g}".format(cycle / count) for count in counts)
            ),
            show(simulation.time_step),
        )
    if simulation.duration < cycle:
        report.add(
            ("simulation", "duration"),
            "must be at least one controller cycle, {:g} s".format(cycle),
            show(simulation.duration),
        )
    if simulation.record_rate > controller.rate:
        report.add(
            ("simulation", "record_rate"),
            "must be at most controller.rate ({:g} Hz)".format(controller.rate),
            show(simulation.record_rate),
        )


def check_starts(report: Report, spec, agents: Tuple[AgentSpec, ...]) -> None:
    """No two agents start further apart than the object reaches."""
    for first, second in combinations(agents, 2):
        length = spec.free_length(first.particle, second.particle)
        distance = _distance(first.start, second.start)
        if _exceeds(distance, length):
            _report_start(
                report,
                first,
                second,
                "is {:.4g} m from {{}}, beyond the free length {:.4g} m of the object between "
                "them".format(distance, length),
            )
        else:
            _check_grips_apart(report, spec, first, second)


def _check_grips_apart(report: Report, spec, first: AgentSpec, second: AgentSpec) -> None:
    """No two particles of two grips start further apart than the object reaches."""
    if not first.further_particles and not second.further_particles:
        return
    for (i, here), (j, there) in product(
        held_points(spec, first).items(), held_points(spec, second).items()
    ):
        length, distance = spec.free_length(i, j), _distance(here, there)
        if _exceeds(distance, length):
            _report_start(
                report,
                first,
                second,
                "puts particles {} and {}, which {{}} and it hold, {:.4g} m apart, beyond the free "
                "length {:.4g} m of the object between them".format(i, j, distance, length),
            )
            return


def check_limits(
    report: Report, spec, agents: Tuple[AgentSpec, ...], controller: ControllerSpec
) -> None:
    """The limits of every pair of agents suit the object, and the start is within them."""
    for first, second in combinations(agents, 2):
        length = spec.free_length(first.particle, second.particle)
        limits = limits_between(spec, first, second, controller)
        between = "{} and {}".format(first.name, second.name)
        if _exceeds(limits.max_distance, length):
            report.add(
                ("controller", "overstretch", "max_distance"),
                "must be at most the free length between {}, {:.4g} m; auto takes a "
                "fraction of it".format(between, length),
                show(limits.max_distance),
            )
        elif limits.min_distance >= limits.max_distance:
            report.add(
                ("controller", "proximity", "min_distance"),
                "must be below the maximum distance between {}, {:.4g} m".format(
                    between, limits.max_distance
                ),
                show(limits.min_distance),
            )
        else:
            _check_start_limits(report, first, second, length, limits)


def _check_start_limits(report: Report, first, second, length: float, limits) -> None:
    distance = _distance(first.start, second.start)
    if _exceeds(distance, length):
        return  # reported by check_starts
    if _exceeds(distance, limits.max_distance):
        _report_start(
            report,
            first,
            second,
            "is {:.4g} m from {{}}, beyond their maximum distance {:.4g} m "
            "(controller.overstretch.max_distance); bring them closer together".format(
                distance, limits.max_distance
            ),
        )
    elif _exceeds(limits.min_distance, distance):
        _report_start(
            report,
            first,
            second,
            "is {:.4g} m from {{}}, below their minimum distance {:.4g} m "
            "(controller.proximity.min_distance); move them apart".format(
                distance, limits.min_distance
            ),
        )


def _report_start(report: Report, first: AgentSpec, second: AgentSpec, message: str) -> None:
    """Report at the one of the two that is not the leader: it is the one to move."""
    moved, other = (first, second) if second.role == LEADER else (second, first)
    report.add(("agents", moved.name, "start"), message.format(other.name), show(list(moved.start)))


def check_workspace(report: Report, agents: Tuple[AgentSpec, ...], leader: LeaderSpec) -> None:
    """The leader starts where it can be moved by hand."""
    if leader.workspace is None:
        return
    start = next(agent.start for agent in agents if agent.role == LEADER)
    box = leader.workspace
    if not all(low <= x <= high for low, x, high in zip(box.lower, start, box.upper)):
        report.add(
            ("leader", "workspace"),
            "must hold the leader's start, {}".format(show(list(start))),
            "{} to {}".format(show(list(box.lower)), show(list(box.upper))),
        )


def check_perturbation(
    report: Report, spec, agents: Tuple[AgentSpec, ...], controller: ControllerSpec
) -> None:
    """Displaced copies stay within the object's reach, one way or the other."""
    shortest = min(
        (
            spec.free_length(first.particle, second.particle)
            for first, second in combinations(agents, 2)
        ),
        default=math.inf,
    )
    if max(map(abs, controller.perturbation)) >= shortest:
        report.add(
            ("controller", "perturbation"),
            "must be smaller than the shortest free length between two agents, {:.4g} m".format(
                shortest
            ),
            show(list(controller.perturbation)),
        )
