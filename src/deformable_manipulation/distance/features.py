"""The result of a distance computation: nearest features of every copy of the object."""

from deformable_manipulation._distance import Distances

__all__ = ["Distances"]
