import numpy as np
import pytest

from deformable_manipulation.ros.loop_trial import Commands


def test_rate_and_share_of_the_states_that_were_answered():
    stamps = 1.6e9 + 0.01 * np.array([0, 1, 2, 4, 5, 8, 9])
    commands = Commands(stamps, np.full(7, 0.002))
    assert commands.rate == pytest.approx(6.0 / 0.09)
    assert commands.answered(100.0) == pytest.approx(0.7)


def test_one_command_has_no_rate():
    commands = Commands(np.array([1.0]), np.array([0.001]))
    assert np.isnan(commands.rate) and commands.answered(100.0) == 1.0
