import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation._control import PiecewiseLinearClassK

slopes = st.tuples(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3))
values = st.floats(-10.0, 10.0)


@given(slopes, values, values)
def test_grows_strictly_through_zero(pair, a, b):
    alpha = PiecewiseLinearClassK(*pair)
    assert alpha(0.0) == 0.0
    low, high = min(a, b), max(a, b)
    assert alpha(low) <= alpha(high)
    if high - low > 1e-9:
        assert alpha(low) < alpha(high)


def test_uses_the_first_slope_where_safe():
    alpha = PiecewiseLinearClassK(1.0, 5.0)
    assert alpha(0.2) == pytest.approx(0.2)
    assert alpha(-0.2) == pytest.approx(-1.0)


@pytest.mark.parametrize("pair", [(0.0, 1.0), (1.0, -1.0), (np.nan, 1.0), (1.0, np.inf)])
def test_refuses_slopes_that_are_not_positive(pair):
    with pytest.raises(ValueError, match="slopes"):
        PiecewiseLinearClassK(*pair)
