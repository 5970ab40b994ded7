"""Barrier that keeps two agents from overstretching the object."""

from deformable_manipulation.control.barriers import PairBarrier, Tier


class OverstretchBarrier(PairBarrier):
    """h = max_distance - |x_j - x_i| (paper, eq. 8 to 10).

    Moving towards agent j raises h: its gradient is a_ij, and the row against the leader is
    a_ij . u_i >= a_ij . v_j - alpha(h).
    """

    tier = Tier.OVERSTRETCH
    sign = -1.0
