"""The result of a distance computation: nearest features of every copy of the object."""

from deformable_manipulation._distance import Distances

NOT_FOLLOWED = -1  # identity of a feature that has none

__all__ = ["NOT_FOLLOWED", "Distances"]
