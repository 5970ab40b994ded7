import threading

import pytest
from messages import distances_message, state_message

from deformable_manipulation.cycles.cycle_pairing import CyclePairing


@pytest.fixture
def pairs():
    return []


@pytest.fixture
def pairing(pairs):
    return CyclePairing(lambda state, distances: pairs.append((state, distances)))


def cycles(pairs):
    return [(state.reset_count, state.cycle) for state, _ in pairs]


def test_nothing_happens_with_one_of_the_two(pairing, pairs):
    pairing.state(state_message(1.0, 0))
    pairing.state(state_message(1.01, 1))
    assert pairs == []
    assert pairing.newest_state.cycle == 1


@pytest.mark.parametrize("state_first", [True, False])
def test_both_of_a_cycle_come_together_in_either_order(pairing, pairs, state_first):
    state, distances = state_message(1.0, 3), distances_message(1.0, 3)
    for take in (pairing.state, pairing.distances)[:: 1 if state_first else -1]:
        take(state if take == pairing.state else distances)
    assert pairs == [(state, distances)]


@pytest.mark.parametrize("behind", ["distances", "state"])
def test_messages_some_cycles_behind_find_their_counterpart(pairing, pairs, behind):
    late = 3
    for cycle in range(10 + late):
        states = cycle - late if behind == "state" else cycle
        distances = cycle - late if behind == "distances" else cycle
        if states >= 0:
            pairing.state(state_message(1.0 + states, states))
        if distances >= 0:
            pairing.distances(distances_message(1.0 + distances, distances))
    assert cycles(pairs) == [(0, cycle) for cycle in range(10)]
    assert all(state.cycle == distances.cycle for state, distances in pairs)


def test_pairs_only_advance(pairing, pairs):
    for cycle in range(3):
        pairing.state(state_message(1.0 + cycle, cycle))
    for cycle in (2, 1, 0):
        pairing.distances(distances_message(1.0 + cycle, cycle))
    assert cycles(pairs) == [(0, 2)]


def test_what_waits_in_vain_is_forgotten(pairing, pairs):
    for cycle in range(1000):
        pairing.state(state_message(1.0 + cycle, cycle))
    pairing.distances(distances_message(1.0, 0))
    assert pairs == []
    pairing.distances(distances_message(1000.0, 999))
    assert cycles(pairs) == [(0, 999)]


def test_messages_of_different_runs_are_never_paired(pairing, pairs):
    pairing.state(state_message(2.0, 0, reset_count=1))
    pairing.distances(distances_message(1.0, 0, reset_count=0))
    assert pairs == []
    pairing.distances(distances_message(2.0, 0, reset_count=1))
    assert cycles(pairs) == [(1, 0)]


def test_a_late_message_is_dropped(pairing, pairs):
    pairing.state(state_message(1.1, 10))
    pairing.state(state_message(1.0, 0))
    pairing.distances(distances_message(1.0, 0))
    assert pairs == []
    pairing.distances(distances_message(1.1, 10))
    assert cycles(pairs) == [(0, 10)]


def test_a_repeated_message_is_answered_once(pairing, pairs):
    for _ in range(2):
        pairing.state(state_message(1.0, 5))
        pairing.distances(distances_message(1.0, 5))
    assert cycles(pairs) == [(0, 5)]


def test_missing_cycles_are_passed_over(pairing, pairs):
    for cycle in (0, 1, 4, 9):
        pairing.state(state_message(1.0 + cycle, cycle))
        pairing.distances(distances_message(1.0 + cycle, cycle))
    assert cycles(pairs) == [(0, 0), (0, 1), (0, 4), (0, 9)]


def test_a_reset_begins_with_cycle_0_again(pairing, pairs):
    for stamp, cycle, resets in ((1.0, 99, 0), (1.01, 0, 1), (1.02, 1, 1)):
        pairing.distances(distances_message(stamp, cycle, resets))
        pairing.state(state_message(stamp, cycle, resets))
    assert cycles(pairs) == [(0, 99), (1, 0), (1, 1)]


def test_a_simulator_that_was_started_again_is_followed(pairing, pairs):
    for stamp, cycle, resets in ((1.0, 99, 3), (5.0, 0, 0), (5.01, 1, 0)):
        pairing.state(state_message(stamp, cycle, resets))
        pairing.distances(distances_message(stamp, cycle, resets))
    assert cycles(pairs) == [(3, 99), (0, 0), (0, 1)]


def test_a_clock_that_was_set_back_is_followed(pairing, pairs):
    for stamp, cycle in ((100.0, 7), (50.0, 8), (50.01, 9)):
        pairing.state(state_message(stamp, cycle))
        pairing.distances(distances_message(stamp, cycle))
    assert cycles(pairs) == [(0, 7), (0, 8), (0, 9)]


def test_two_threads_give_each_cycle_once(pairing, pairs):
    count = 2000
    both = threading.Barrier(2)

    def send(take, make):
        for cycle in range(count):
            take(make(1.0 + cycle, cycle))
            both.wait()

    threads = [
        threading.Thread(target=send, args=arguments)
        for arguments in ((pairing.state, state_message), (pairing.distances, distances_message))
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert cycles(pairs) == [(0, cycle) for cycle in range(count)]
