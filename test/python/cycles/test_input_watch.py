import pytest

from deformable_manipulation.cycles.input_watch import InputWatch, find_age_fault

TIMEOUT = 0.2


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def watch(clock):
    return InputWatch(("state", "distances"), TIMEOUT, clock)


def test_inputs_that_have_never_come_are_named(watch):
    assert watch.fault() == "no state yet, no distances yet"
    watch.received("state")
    assert watch.fault() == "no distances yet"


def test_inputs_that_stop_coming_are_named_until_they_come_again(watch, clock):
    watch.received("state")
    watch.received("distances")
    clock.now += 0.9 * TIMEOUT
    assert watch.fault() == ""
    watch.received("state")
    clock.now += 0.9 * TIMEOUT
    assert watch.fault() == "no distances for 0.4 s"
    watch.received("distances")
    assert watch.fault() == ""


@pytest.mark.parametrize(
    "age, expected",
    [
        (0.0, ""),
        (0.9 * TIMEOUT, ""),
        (-0.9 * TIMEOUT, ""),
        (1.0, "its stamp is 1.0 s old"),
        (-1.0, "its stamp is 1.0 s in the future; synchronise the clocks"),
    ],
)
def test_the_age_by_the_stamp(age, expected):
    assert find_age_fault(age, TIMEOUT) == expected
