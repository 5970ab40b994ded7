"""What all barriers share: tiers, rows, the situation they look at, pairs of agents."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from deformable_manipulation.control.class_k import PiecewiseLinearClassK


class Tier(IntEnum):
    """Kinds of constraints in their priority: the last one is relaxed first."""

    COLLISION = 0
    OVERSTRETCH = 1
    PROXIMITY = 2


@dataclass(frozen=True)
class Rows:
    """Constraints ``coefficients @ u >= bounds`` on one agent's velocity u [m/s]."""

    tier: Tier
    coefficients: np.ndarray  # (R, 3)
    bounds: np.ndarray  # (R,) m/s


@dataclass(frozen=True)
class Situation:
    """Motion of the A agents, as predicted for the time at which the command acts.

    The command computed from state k acts from state k + 1 on. Until then, for ``delay`` seconds,
    the own agent moves with its previous command and the others with their measured velocities.
    """

    positions: np.ndarray  # (A, 3) m, held points at state k + 1
    velocities: np.ndarray  # (A, 3) m/s, from state k to k + 1
    leader_velocity: np.ndarray  # (3,) m/s, measured; the constraints expect it to last
    delay: float  # s, from state k to k + 1


class PairBarrier:
    """A barrier on the distance r between this agent's held point i and each other one j.

    With the unit vector a = (x_j - x_i) / r, dr/dt = a . (v_j - u_i). For h = sign * (r - limit)
    the gradient with respect to x_i is g = -sign * a, and dh/dt >= -alpha(h) becomes

        g . u_i >= g . v_j - alpha(h).

    Against the leader, whose velocity v_j is measured, this agent takes the whole constraint.
    Two assistants share it. Each feeding back the other's last measured velocity would be a loop
    of gain one with a delay, so each keeps its velocity relative to the leader's within half:

        g_i . (u_i - v_leader) >= -alpha(h) / 2.

    As g_j = -g_i, the two halves sum to the whole constraint for any leader velocity, and a
    formation that moves as one with the leader is never held back.

    Coincident held points have no direction; a fixed one is taken instead, along x from the
    agent of the lower index to the other, so that both agents take opposite ones.

    Args:
        agent: index of this agent.
        leader: index of the leader.
        limits: (A,) distances to keep to [m]; the own entry is not used.
        slopes: of the :class:`~.class_k.PiecewiseLinearClassK` [1/s].
    """

    tier: Tier
    sign: float  # +1: stay farther than the limit, -1: stay nearer

    def __init__(self, agent, leader, limits, slopes):
        others = [j for j in range(len(limits)) if j != agent]
        self._agent = agent
        self._others = np.array(others, dtype=int)
        self._limits = np.asarray(limits, dtype=float)[others]
        self._shares = np.where(self._others == leader, 1.0, 0.5)
        self._fallback = np.where(self._others > agent, 1.0, -1.0)[:, None] * (1.0, 0.0, 0.0)
        self._alpha = PiecewiseLinearClassK(slopes)

    def value(self, positions):
        """h (A - 1,) [m] for each other agent, from the held points (A, 3)."""
        return self._evaluate(positions)[0]

    def gradient(self, positions):
        """dh / dx_i (A - 1, 3) with respect to this agent's held point."""
        return self._evaluate(positions)[1]

    def rows(self, situation):
        """The constraints of a :class:`Situation` as :class:`Rows`, one per other agent."""
        h, gradient = self._evaluate(situation.positions)
        bounds = gradient @ situation.leader_velocity - self._shares * self._alpha(h)
        return Rows(self.tier, gradient, bounds)

    def _evaluate(self, positions):
        offsets = positions[self._others] - positions[self._agent]
        ranges = np.sqrt(np.einsum("ij,ij->i", offsets, offsets))
        apart = ranges > np.finfo(float).tiny
        directions = np.where(apart[:, None], offsets, self._fallback)
        directions = directions / np.where(apart, ranges, 1.0)[:, None]
        return self.sign * (ranges - self._limits), -self.sign * directions
