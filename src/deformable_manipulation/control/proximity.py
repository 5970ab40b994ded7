"""Barrier that keeps two agents apart."""

from deformable_manipulation.control.barriers import PairBarrier, Tier


class ProximityBarrier(PairBarrier):
    """h = |x_j - x_i| - min_distance (paper, eq. 11 and 12).

    Moving away from agent j raises h: its gradient is -a_ij, and the row against the leader is
    -a_ij . u_i >= -a_ij . v_j - alpha(h).
    """

    tier = Tier.PROXIMITY
    sign = 1.0
