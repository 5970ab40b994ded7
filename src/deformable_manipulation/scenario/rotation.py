"""Rotation of vectors by unit quaternions (x, y, z, w), on plain tuples."""

from deformable_manipulation.scenario.spec import Quaternion, Vector


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotate(quaternion: Quaternion, vector: Vector) -> Vector:
    """The vector turned by the unit quaternion: v + 2 w (q x v) + 2 q x (q x v)."""
    axis, w = quaternion[:3], quaternion[3]
    once = _cross(axis, vector)
    twice = _cross(axis, once)
    return tuple(v + 2.0 * (w * a + b) for v, a, b in zip(vector, once, twice))
