"""Rotations as unit quaternions (x, y, z, w), on plain tuples."""

import math
from typing import Sequence

from deformable_manipulation.geometry.pose import Quaternion, Vector

_SMALL = 1e-4  # rad, below which series are exact to rounding


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    """Cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotate(quaternion: Quaternion, vector: Vector) -> Vector:
    """The vector turned by the unit quaternion: v + 2 w (q x v) + 2 q x (q x v)."""
    axis, w = quaternion[:3], quaternion[3]
    once = cross(axis, vector)
    twice = cross(axis, once)
    return tuple(v + 2.0 * (w * a + b) for v, a, b in zip(vector, once, twice))


def multiply(second: Quaternion, first: Quaternion) -> Quaternion:
    """The rotation ``first``, followed by ``second``, both about fixed axes; of norm 1."""
    a, b = second[:3], first[:3]
    w = second[3] * first[3] - (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
    vector = (second[3] * y + first[3] * x + c for x, y, c in zip(a, b, cross(a, b)))
    product = (*vector, w)
    norm = math.sqrt(sum(c * c for c in product))
    return tuple(c / norm for c in product)


def conjugate(quaternion: Quaternion) -> Quaternion:
    """The rotation back."""
    x, y, z, w = quaternion
    return (-x, -y, -z, w)


def from_vector(rotation: Sequence[float]) -> Quaternion:
    """The rotation about the direction of a vector by its length [rad]."""
    half = 0.5 * math.sqrt(sum(c * c for c in rotation))
    factor = 0.5 * (math.sin(half) / half if half > _SMALL else 1.0 - half * half / 6.0)
    return tuple(factor * c for c in rotation) + (math.cos(half),)


def to_vector(quaternion: Quaternion) -> Vector:
    """The inverse of :func:`from_vector`, of a length of at most pi."""
    sign = -1.0 if quaternion[3] < 0.0 else 1.0
    sine = math.sqrt(sum(c * c for c in quaternion[:3]))
    angle = 2.0 * math.atan2(sine, sign * quaternion[3])
    factor = angle / sine if sine > 0.5 * _SMALL else 2.0
    return tuple(sign * factor * c for c in quaternion[:3])


def angular_velocity(rotation: Sequence[float], rate: Sequence[float]) -> Vector:
    """Angular velocity [rad/s], about fixed axes, of ``from_vector(rotation)``.

    ``J rate`` with the left Jacobian of SO(3),
    ``J = 1 + (1 - cos a) / a^2 [r]x + (a - sin a) / a^3 [r]x^2``, a the length of r.
    """
    angle = math.sqrt(sum(c * c for c in rotation))
    once = cross(rotation, rate)
    twice = cross(rotation, once)
    if angle > _SMALL:
        first = (1.0 - math.cos(angle)) / angle**2
        second = (angle - math.sin(angle)) / angle**3
    else:
        first, second = 0.5, 1.0 / 6.0
    return tuple(v + first * a + second * b for v, a, b in zip(rate, once, twice))


def rate_of(rotation: Vector, angular: Vector) -> Vector:
    """The inverse of :func:`angular_velocity` by its second argument, for less than a turn."""
    angle = math.sqrt(sum(c * c for c in rotation))
    once = cross(rotation, angular)
    twice = cross(rotation, once)
    if angle > _SMALL:
        factor = (1.0 - 0.5 * angle / math.tan(0.5 * angle)) / angle**2
    else:
        factor = 1.0 / 12.0
    return tuple(v - 0.5 * a + factor * b for v, a, b in zip(angular, once, twice))
