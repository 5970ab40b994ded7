"""Gradients of distances from the exact response of the object to its held points."""

import numpy as np

from deformable_manipulation.control.features import features_of


def exact_features(distances, sensitivities, leader, nearest_only=False):
    """Features of the object itself with the gradients of its quasi-static equilibrium.

    The distance of a locally nearest pair changes with its material point's motion along the
    normal: g[m, a, j] = normal . dX_m / dp_aj, X_m = sum_k weights_k points_k.

    Args:
        distances: :class:`~deformable_manipulation.distance.features.Distances`.
        sensitivities: (A, P, 3, 3) d point / d held point.
        leader: index of the leader.
        nearest_only: only the feature of the minimum, if there is one.

    Returns:
        :class:`~.features.Features`.
    """
    chosen = distances.of_copy(0)
    if nearest_only:
        chosen = slice(chosen.start, min(chosen.start + 1, chosen.stop))
    along_normal = np.einsum("mk,mi->mki", distances.weights[chosen], distances.normal[chosen])
    of_vertices = sensitivities[:, distances.vertices[chosen]]  # (A, M, 3, 3, 3)
    gradients = np.einsum("amkij,mki->maj", of_vertices, along_normal)
    gradients[:, leader] = 0.0
    return features_of(distances, chosen, gradients, leader)
