import os
import signal

import pytest

from deformable_manipulation.system.interruption import (
    check_interruption,
    exit_status,
    interruptible,
)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_request_to_end_is_not_lost_where_something_catches_it(number):
    caught = False
    with pytest.raises(KeyboardInterrupt) as interrupt, interruptible():
        check_interruption()
        try:
            os.kill(os.getpid(), number)
        except BaseException:
            caught = True
        check_interruption()
    assert caught
    assert exit_status(interrupt.value) == 128 + number
    check_interruption()  # what is over does not come back


def test_handlers_are_as_before_afterwards():
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    with interruptible():
        pass
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before
