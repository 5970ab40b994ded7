"""A rope between grippers of a width: all that computes with it knows its segments."""

import numpy as np
import pytest

from deformable_manipulation.control.status import Status
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

GRIPS = (
    ("agents.leader.grip_length", "0.02"),
    ("agents.assistant_1.grip_length", "0.02"),
)


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("rope_one_assistant", GRIPS)


@pytest.fixture(scope="module")
def records(scenario):
    loop = ClosedLoop(scenario)
    return [loop.step() for _ in range(scenario.cycles)]


def test_the_limit_is_active_and_kept(records):
    lowest = min(record.decisions["assistant_1"].h["collision"] for record in records)
    assert 0.0 <= lowest < 0.01


def test_nothing_had_to_be_relaxed(records):
    outcomes = {record.decisions["assistant_1"].status for record in records}
    assert Status.CONSTRAINED in outcomes
    assert outcomes <= {Status.NOMINAL, Status.CONSTRAINED}


def test_the_segments_keep_their_lengths(scenario, records):
    lengths = np.linalg.norm(np.diff(records[-1].points, axis=0), axis=1)
    np.testing.assert_allclose(lengths, scenario.object.segment_lengths, rtol=1e-4)
