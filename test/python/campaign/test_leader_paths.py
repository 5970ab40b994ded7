import numpy as np
import pytest

from deformable_manipulation.campaign.leader_paths import PathLimits, random_waypoints
from deformable_manipulation.leader import LeaderPath

LIMITS = PathLimits((-0.2, -0.3, -1.0), (0.2, 2.0, 0.0), top_speed=0.1, travel=30.0, rest=5.0)
PILLAR = np.array([0.0, 1.0, -0.5])


def anywhere(_positions):
    return True


def off_the_pillar(positions):
    return (np.linalg.norm((positions - PILLAR)[:, 1:], axis=1) > 0.3).all()


def path_of(seed, is_clear=anywhere):
    waypoints = random_waypoints(np.random.default_rng(seed), LIMITS, is_clear)
    path = LeaderPath(waypoints)
    times = np.arange(0.0, waypoints[-1].time, 0.02)
    return waypoints, path.position(times), path.velocity(times)


@pytest.mark.parametrize("seed", range(10))
def test_stays_within_box_and_speed(seed):
    waypoints, positions, velocities = path_of(seed)
    assert (positions >= np.array(LIMITS.lower) - 1e-9).all()
    assert (positions <= np.array(LIMITS.upper) + 1e-9).all()
    fastest = np.abs(velocities).max()
    assert 0.2 * LIMITS.top_speed < fastest <= LIMITS.top_speed + 1e-9
    assert waypoints[-2].time >= LIMITS.travel
    assert waypoints[-1].time - waypoints[-2].time == pytest.approx(LIMITS.rest)
    np.testing.assert_allclose(positions[[0, -1]], 0.0, atol=1e-12)


@pytest.mark.parametrize("seed", range(10))
def test_stays_clear(seed):
    _, positions, _ = path_of(seed, off_the_pillar)
    # Between the times that are asked for, a path bends by less than this.
    assert np.linalg.norm((positions - PILLAR)[:, 1:], axis=1).min() > 0.29


def test_equal_seeds_give_equal_paths_and_others_do_not():
    assert path_of(3)[0] == path_of(3)[0]
    assert path_of(3)[0] != path_of(4)[0]


def test_a_blocked_box_is_told():
    with pytest.raises(RuntimeError, match="no clear path"):
        random_waypoints(
            np.random.default_rng(0), LIMITS, lambda positions: not np.any(positions)
        )


@pytest.mark.parametrize(
    "changed",
    [
        {"lower": (0.1, 0.0, 0.0)},
        {"upper": (0.0, np.inf, 0.0)},
        {"lower": (0.0, 0.0)},
        {"lower": (0.0, 0.0, 0.0), "upper": (0.0, 0.0, 0.0)},
        {"top_speed": 0.0},
        {"travel": np.nan},
        {"rest": -1.0},
    ],
)
def test_limits_that_make_no_sense_are_refused(changed):
    given = dict(lower=(-1.0, 0.0, 0.0), upper=(1.0, 0.0, 0.0), top_speed=0.1, travel=9.0, rest=1.0)
    with pytest.raises(ValueError, match=next(iter(changed))):
        PathLimits(**{**given, **changed})
