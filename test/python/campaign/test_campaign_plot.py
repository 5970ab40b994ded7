"""What the picture of a campaign shows."""

from types import SimpleNamespace

import pytest

from deformable_manipulation.campaign.plots import plot_campaign

OFFSET = 0.05  # m


def outcomes(*distances):
    return [
        SimpleNamespace(min_distance=each, oscillation=2e-4, final_error=1e-9) for each in distances
    ]


def test_the_limit_is_drawn_where_it_is_and_told():
    distance = plot_campaign(outcomes(0.052, 0.054), OFFSET, "rope").axes[0]
    limit = distance.lines[1].get_xdata()
    low, high = distance.get_xlim()
    assert set(limit) == {0.0} and low < 0.0 < high
    assert [text.get_text() for text in distance.get_legend().get_texts()] == ["limit 50 mm"]
    assert max(distance.lines[0].get_xdata()) == pytest.approx(4.0)  # mm


def test_rounding_errors_look_like_zero():
    for panel in plot_campaign(outcomes(0.052, 0.054), OFFSET, "rope").axes[1:]:
        low, high = panel.get_xlim()
        assert -0.1 < low < 0.0 and high >= 1.0
