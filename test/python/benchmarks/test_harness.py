"""How operations are timed, on a clock that goes on only when it is told to."""

import gc
from itertools import cycle

import numpy as np
import pytest
from fake_clock import FakeClock

from deformable_manipulation.benchmarks.harness import Effort, Timing, measure, measure_each

EFFORT = Effort(repetitions=5, least_time=0.01)


def test_an_operation_takes_what_it_takes():
    clock = FakeClock()
    timing = measure(lambda _: clock.spend(3e-4), effort=EFFORT, clock=clock)
    assert len(timing.seconds) == EFFORT.repetitions
    assert timing.seconds == pytest.approx([3e-4] * EFFORT.repetitions)
    assert timing.inner * 3e-4 >= EFFORT.least_time


@pytest.mark.parametrize("cost", [1e-7, 1e-3, 0.5])
def test_a_repetition_lasts_long_enough_but_not_for_ever(cost):
    clock = FakeClock()
    inner = measure(lambda _: clock.spend(cost), effort=EFFORT, clock=clock).inner
    assert EFFORT.least_time <= inner * cost <= max(cost, 2.0 * EFFORT.least_time)


def test_a_coarse_clock_is_enough():
    clock = FakeClock(resolution=0.004)
    timing = measure(lambda _: clock.spend(1e-5), effort=EFFORT, clock=clock)
    assert timing.median == pytest.approx(1e-5, rel=0.5)


def test_every_repetition_gets_a_state_of_its_own_outside_of_the_measured_time():
    clock = FakeClock()
    made, used = [], []

    def prepare():
        clock.spend(1.0)
        made.append(object())
        return made[-1]

    def operation(state):
        clock.spend(0.02)
        used.append(state)

    timing = measure(operation, prepare, EFFORT, clock)
    assert timing.inner == 1
    assert timing.median == pytest.approx(0.02)
    assert used == made and len(set(map(id, made))) == 1 + EFFORT.repetitions


def test_median_and_minimum_of_uneven_repetitions():
    clock = FakeClock()
    costs = iter([0.02, 0.05, 0.03, 0.02, 0.09, 0.04])  # the first one warms up
    timing = measure(lambda _: clock.spend(next(costs)), effort=EFFORT, clock=clock)
    assert (timing.median, timing.minimum) == pytest.approx((0.04, 0.02))


def test_quantiles_are_those_of_numpy():
    seconds = np.random.default_rng(3).exponential(size=101)
    timing = Timing(list(seconds))
    for fraction in (0.0, 0.25, 0.5, 0.99, 1.0):
        assert timing.quantile(fraction) == pytest.approx(np.quantile(seconds, fraction))
    assert Timing([2.0]).quantile(0.99) == 2.0


@pytest.mark.parametrize("fraction", [-0.1, 1.1, float("nan")])
def test_no_quantile_beyond_the_range(fraction):
    with pytest.raises(ValueError, match="0 to 1"):
        Timing([1.0]).quantile(fraction)


def test_a_part_of_an_operation():
    part = Timing([2.0, 4.0], inner=3).per(4)
    assert (part.seconds, part.inner) == ([0.5, 1.0], 12)


def test_each_call_is_timed_after_a_round_that_is_not():
    clock = FakeClock()
    calls = []

    def call(name, cost):
        calls.append(name)
        clock.spend(cost)

    timing = measure_each([lambda: call("a", 1.0), lambda: call("b", 3.0)], 2, clock)
    assert calls == ["a", "b"] * 3
    assert timing.seconds == [1.0, 3.0] * 2


def test_the_garbage_collector_waits_and_comes_back():
    clock = FakeClock()
    during = []

    def operation(_):
        during.append(gc.isenabled())
        clock.spend(0.02)
        if len(during) == 3:
            raise OSError

    assert gc.isenabled()
    with pytest.raises(OSError):
        measure(operation, effort=EFFORT, clock=clock)
    assert gc.isenabled() and not any(during)


@pytest.mark.parametrize("wrong", [(0, 0.01), (3, 0.0), (3, float("nan")), (3, float("inf"))])
def test_an_effort_that_measures_nothing_is_refused(wrong):
    with pytest.raises(ValueError, match="at least one repetition"):
        Effort(*wrong)


def test_uneven_costs_do_not_confuse_the_number_of_loops():
    clock = FakeClock()
    costs = cycle([1e-3, 1e-6, 1e-6])
    timing = measure(lambda _: clock.spend(next(costs)), effort=EFFORT, clock=clock)
    assert timing.inner * timing.minimum >= 0.5 * EFFORT.least_time
