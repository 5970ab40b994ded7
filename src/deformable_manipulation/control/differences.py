"""Gradients of distances by differences over perturbed copies of the object."""

import numpy as np

from deformable_manipulation.control.features import features_of

_SMALLEST_DISPLACEMENT = 1e-6  # m, below which a difference is rounding


class Differences:
    """Displacement rates of the object, kept over the cycles (paper, section V-B).

    For each agent with copies, the rates R[a, j] = dX / dp_aj of all points X and of the minimum
    distance with respect to the three components of its held point p_a are (X_c - X_0) / d for a
    copy c displaced by d along one axis. Displacements in any other directions are solved for
    together: opposite ones give central differences, oblique ones the least-squares solution.
    Only copies that are ready count; along the directions that no ready copy spans, the last
    rates are held.

    The leader has no copies. Moving all held points together moves the object rigidly, however
    it is held, so the gradients of all agents sum to the normal and the leader's is the rest:
    J_leader = normal - sum of the others. Beside the three copies that this saves, it makes the
    predicted rate exact for a formation that moves as one, where differences over 0.1 m for each
    agent separately have a bias that does not cancel. Copies of the leader are not used. An
    assistant without usable copies counts as moving with the leader: its part is in the rest.

    Args:
        agents: number of agents A.
        leader: index of the leader.
    """

    def __init__(self, agents, leader):
        self._agents = agents
        self._leader = leader
        self.reset()

    def reset(self):
        """Forget all rates."""
        self._rates = None  # (A, 3, 3 P + 1): coordinates of the points, then the minimum
        self._known = np.zeros(self._agents, dtype=bool)
        self._inverses = {}

    def known(self, agent):
        """Whether all copies of an agent have been ready at once since the start or reset."""
        return bool(self._known[agent])

    def update(self, observation):
        """Take in the copies of an :class:`~.observation.Observation`."""
        copies = len(observation.points)
        minimum = np.where(np.isfinite(observation.distances.minimum),
                           observation.distances.minimum, 0.0)
        values = np.column_stack((observation.points.reshape(copies, -1), minimum))
        if self._rates is None or self._rates.shape[2] != values.shape[1]:
            self.reset()
            self._rates = np.zeros((self._agents, 3, values.shape[1]))
        for agent in range(self._agents):
            if agent != self._leader:
                self._update_agent(agent, observation, values)

    def _update_agent(self, agent, observation, values):
        own = observation.displaced_agents == agent
        displaced = np.abs(observation.displacements).max(axis=1) > _SMALLEST_DISPLACEMENT
        usable = np.flatnonzero(own & displaced & observation.ready)
        if not own.any():
            self._known[agent] = False
            self._rates[agent] = 0.0
        elif usable.size:
            self._known[agent] |= usable.size == np.count_nonzero(own)
            displacements = observation.displacements[usable]
            change = values[usable] - values[0]
            rates = self._rates[agent]
            rates += self._inverse(agent, displacements) @ (change - displacements @ rates)

    def _inverse(self, agent, displacements):
        """Pseudoinverse of an agent's displacements, kept while they stay the same."""
        cached = self._inverses.get(agent)
        if cached is None or not np.array_equal(cached[0], displacements):
            cached = (displacements, np.linalg.pinv(displacements))
            self._inverses[agent] = cached
        return cached[1]

    def features(self, distances):
        """All features of copy 0, each with the rates of its own material point.

        The distance of a locally nearest pair changes with its material points' motion along the
        normal: g[m, a, j] = normal . dX_m / dp_aj.
        """
        chosen = distances.of_copy(0)
        vertices, normal = distances.vertices[chosen], distances.normal[chosen]
        rates = self._rates[:, :, :-1].reshape(self._agents, 3, -1, 3)
        along_normal = np.einsum("mk,mi->mki", distances.weights[chosen], normal)
        gradients = np.einsum("ajmki,mki->maj", rates[:, :, vertices], along_normal)
        return features_of(distances, chosen, gradients, self._leader)

    def minimum(self, distances):
        """The nearest feature of copy 0 with the rates of the minimum distance (paper, eq. 6)."""
        start = int(distances.offsets[0])
        chosen = slice(start, min(start + 1, int(distances.offsets[1])))
        gradients = np.repeat(self._rates[None, :, :, -1], chosen.stop - chosen.start, axis=0)
        return features_of(distances, chosen, gradients, self._leader)
