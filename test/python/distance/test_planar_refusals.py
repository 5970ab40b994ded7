"""Input that is refused, with its reason."""

import numpy as np
import pytest
from planar_reference import SQUARE, obstacle

from deformable_manipulation.distance.minimum_distance import MinimumDistance

BOW_TIE = ((0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0))


@pytest.mark.parametrize(
    "changes, reason",
    [
        ({"ring": BOW_TIE}, "crosses or touches itself"),
        ({"ring": SQUARE[:2]}, "3 distinct points"),
        ({"ring": ((0, 0), (1, 1), (2, 2))}, "no area"),
        ({"ring": SQUARE[:3] + ((0.0, np.nan),)}, "finite"),
        ({"translation": (0.0, np.inf, 0.0)}, "translation"),
        ({"rotation": (0.0, 0.0, 0.0, 0.0)}, "rotation"),
        ({"rotation": (np.nan, 0.0, 0.0, 1.0)}, "rotation"),
        ({"rotation": (0.0, 0.0, 1.0, 1.0)}, "length 1"),
        ({"plane": "zy"}, "'xy', 'yz', 'xz'"),
    ],
)
def test_bad_obstacle(changes, reason):
    settings = dict({"ring": SQUARE, "name": "block"}, **changes)
    with pytest.raises(ValueError, match="obstacle 'block'.*" + reason):
        MinimumDistance([obstacle(**settings)], 0.01)


def test_all_mistakes_are_reported_at_once():
    spoilt = [
        obstacle(BOW_TIE, name="first"),
        obstacle(SQUARE, name="second", plane="up", translation=(np.nan, 0.0, 0.0)),
    ]
    with pytest.raises(ValueError) as caught:
        MinimumDistance(spoilt, -1.0, band=np.nan)
    message = str(caught.value)
    for part in (
        "margin is -1.0",
        "band is nan",
        "'first'",
        "plane is 'up'",
        "translation",
    ):
        assert part in message


@pytest.mark.parametrize("shape", [(2, 3), (0, 4, 3), (1, 1, 3), (1, 4, 2)])
def test_points_of_another_shape(shape):
    with pytest.raises(ValueError, match="shape"):
        MinimumDistance([obstacle(SQUARE)], 0.01).compute(np.zeros(shape))


def test_points_that_are_not_finite():
    points = np.zeros((2, 4, 3))
    points[1, 2, 0] = np.nan
    with pytest.raises(ValueError, match="point 2 of copy 1"):
        MinimumDistance([obstacle(SQUARE)], 0.01).compute(points)
