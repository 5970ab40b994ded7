"""Confidence intervals of fractions."""

import numpy as np
import pytest
from scipy.stats import binom

from deformable_manipulation.campaign.confidence import interval


def test_known_values():
    """None of n: 1 - 0.025^(1/n); the rule of three for one side would be 3/n."""
    assert interval(0, 100) == pytest.approx((0.0, 1.0 - 0.025**0.01))
    assert interval(100, 100) == pytest.approx((0.025**0.01, 1.0))
    assert interval(5, 10) == pytest.approx((0.187, 0.813), abs=1e-3)


@pytest.mark.parametrize("total", [7, 40])
def test_it_holds_the_truth_often_enough(total):
    intervals = np.array([interval(count, total) for count in range(total + 1)])
    for truth in np.linspace(0.01, 0.99, 25):
        inside = (intervals[:, 0] <= truth) & (truth <= intervals[:, 1])
        assert binom.pmf(np.arange(total + 1), total, truth)[inside].sum() >= 0.95
