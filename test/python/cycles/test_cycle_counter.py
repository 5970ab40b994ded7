import pytest
from messages import state_message

from deformable_manipulation.cycles.cycle_counter import CycleCounter

PERIOD = 0.01  # s


@pytest.fixture
def counter():
    return CycleCounter(PERIOD)


def counts(counter):
    return counter.answered, counter.overruns, counter.skipped


def test_answers_in_time_are_no_overruns(counter):
    for cycle in range(5):
        assert not counter.count(state_message(cycle=cycle), age=PERIOD)
    assert counts(counter) == (5, 0, 0)


def test_an_answer_later_than_a_cycle_is_an_overrun(counter):
    assert counter.count(state_message(cycle=0), age=1.001 * PERIOD)
    assert not counter.count(state_message(cycle=1), age=0.5 * PERIOD)
    assert counts(counter) == (2, 1, 0)


def test_states_that_never_came_are_skipped(counter):
    assert not counter.count(state_message(cycle=7))  # those before the node was there do not count
    assert counter.count(state_message(cycle=10))
    assert counts(counter) == (2, 0, 2)


def test_a_reset_or_a_new_simulator_skips_nothing(counter):
    counter.count(state_message(cycle=3))
    assert not counter.count(state_message(cycle=5, reset_count=1))
    assert not counter.count(state_message(cycle=0, reset_count=1))
    assert counts(counter) == (3, 0, 0)


def test_the_summary_has_all_counts(counter):
    counter.count(state_message(cycle=0), age=1.0)
    counter.count(state_message(cycle=4))
    assert counter.summary == "Overruns: 1 of 2 cycles, 3 states skipped."


def test_one_skipped_state_is_told_in_the_singular(counter):
    counter.count(state_message(cycle=0))
    counter.count(state_message(cycle=2))
    assert counter.summary.endswith("1 state skipped.")
