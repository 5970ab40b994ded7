"""Nearest features of the object with their gradients."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Features:
    """M nearest features of the object itself with their gradients.

    ``gradients[m, a] . v`` is the rate at which feature m's distance grows when agent a's held
    point moves with the velocity v.
    """

    distance: np.ndarray  # (M,) m, signed
    normal: np.ndarray  # (M, 3) unit vector along which the distance grows fastest
    obstacle_velocity: np.ndarray  # (M, 3) m/s
    gradients: np.ndarray  # (M, A, 3)


def features_of(distances, chosen, gradients, leader):
    """The :class:`Features` in some rows of Distances.

    Args:
        distances: :class:`~deformable_manipulation.distance.features.Distances`.
        chosen: slice of its rows (M).
        gradients: (M, A, 3) of all agents but the leader, whose rows are zero. Moving all held
            points together moves the object rigidly, so that the gradients of all agents sum to
            the normal: the leader gets the rest.
        leader: index of the leader.
    """
    normal = distances.normal[chosen]
    gradients[:, leader] = normal - gradients.sum(axis=1)
    return Features(
        distance=distances.distance[chosen],
        normal=normal,
        obstacle_velocity=distances.obstacle_velocity[chosen],
        gradients=gradients,
    )
