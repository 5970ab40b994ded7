"""Barrier that keeps the object off the obstacles."""

import numpy as np

from deformable_manipulation.control.barriers import Rows, Tier
from deformable_manipulation.control.class_k import PiecewiseLinearClassK

# Squared gradient [1] below which an assistant has no say in a feature's distance: the shares
# then turn to equal ones, smoothly.
_NEGLIGIBLE = 1e-6


class CollisionBarrier:
    """h_m = distance_m - offset for each near feature m (paper, eq. 3 to 7).

    With the gradients g_a of agent a, the normal n, the obstacle's velocity w and
    sum over all agents g_a = n (see :class:`~.differences.Differences`),

        dh/dt = sum_a g_a . v_a - n . w
              = sum over assistants g_i . (u_i - v_leader) + n . (v_leader - w).

    Assistants share dh/dt >= -alpha(h) in proportion to what they can do, s_i = g_i^2 / sum g^2:

        g_i . (u_i - v_leader) >= -s_i (n . (v_leader - w) + alpha(h)).

    The shares sum to the whole constraint; no assistant's velocity is fed back to another, and a
    formation that moves as one with the leader along the obstacle is not held back. For a single
    assistant this is g . u + g_leader . v_leader - n . w >= -alpha(h).

    Args:
        agent: index of this agent.
        assistants: indices of all assistants, this agent among them.
        offset: distance to keep [m].
        slopes: of the :class:`~.class_k.PiecewiseLinearClassK` [1/s].
        feedforward: False leaves the leader's velocity out, as the paper does.
    """

    tier = Tier.COLLISION

    def __init__(self, agent, assistants, offset, slopes, feedforward=True):
        self._agent = agent
        self._assistants = np.array(assistants, dtype=int)
        self._own = assistants.index(agent)
        self._offset = float(offset)
        self._alpha = PiecewiseLinearClassK(slopes)
        self._feedforward = feedforward

    def value(self, distance):
        """h [m] of signed distances [m]."""
        return distance - self._offset

    def gradient(self, features):
        """dh / dx_i (M, 3) with respect to this agent's held point."""
        return features.gradients[:, self._agent]

    def rows(self, features, situation):
        """The constraints as :class:`~.barriers.Rows`, one per feature.

        Args:
            features: :class:`~.differences.Features` of the present state.
            situation: :class:`~.barriers.Situation`.
        """
        gradient = self.gradient(features)
        h = self.value(self._predicted_distance(features, situation))
        leader_velocity = self._leader_velocity(situation)
        carried = self._relative(features, leader_velocity)
        bounds = gradient @ leader_velocity - self._shares(features) * (carried + self._alpha(h))
        return Rows(self.tier, gradient, bounds)

    def _leader_velocity(self, situation):
        return situation.leader_velocity if self._feedforward else np.zeros(3)

    @staticmethod
    def _relative(features, velocity):
        """Rate (M,) [m/s] at which the distances grow if the whole object moves at a velocity."""
        return np.einsum("mi,mi->m", features.normal, velocity - features.obstacle_velocity)

    def _predicted_distance(self, features, situation):
        """Distances (M,) [m] when the command starts to act, to first order."""
        leader_velocity = self._leader_velocity(situation)
        departures = situation.velocities[self._assistants] - leader_velocity
        rate = self._relative(features, leader_velocity) + np.einsum(
            "maj,aj->m", features.gradients[:, self._assistants], departures
        )
        return features.distance + situation.delay * rate

    def _shares(self, features):
        gradients = features.gradients[:, self._assistants]
        squares = np.einsum("maj,maj->ma", gradients, gradients) + _NEGLIGIBLE
        return squares[:, self._own] / squares.sum(axis=1)
