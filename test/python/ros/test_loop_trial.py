import numpy as np
import pytest

from deformable_manipulation.ros.loop_trial import Commands, read_overruns


def test_rate_and_share_of_the_states_that_were_answered():
    stamps = 1.6e9 + 0.01 * np.array([0, 1, 2, 4, 5, 8, 9])
    commands = Commands(stamps, np.full(7, 0.002))
    assert commands.rate == pytest.approx(6.0 / 0.09)
    assert commands.answered(100.0) == pytest.approx(0.7)


def test_one_command_has_no_rate():
    commands = Commands(np.array([1.0]), np.array([0.001]))
    assert np.isnan(commands.rate) and commands.answered(100.0) == 1.0


def test_what_nodes_say_of_overruns_is_found_among_the_rest_of_the_log():
    log = (
        "\x1b[0m/simulator: Overruns: 1 of 300 cycles.\x1b[0m\n"
        "/assistants: Overruns: 2 of 7 cycles, 1 state skipped.\n"
        "/assistants: Waits, at rest or slowing down to it: no state for 0.3 s.\n"
        "[leader-3] killing on exit\n"
        "/assistants: Overruns: 4 of 298 cycles, 3 states skipped.\n"
    )
    assert read_overruns(log) == {"simulator": (1, None), "assistants": (4, 3)}
