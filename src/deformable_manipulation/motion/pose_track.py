"""An obstacle whose poses are measured."""

import math
from typing import Any

import numpy as np

from deformable_manipulation._control import VelocityEstimator
from deformable_manipulation.geometry.rotation import conjugate, from_vector, multiply
from deformable_manipulation.motion.obstacle_motion import MovingPose

# Faster than this is no motion but a leap: the obstacle was put there.
_LARGEST_SPEED = 5.0  # m/s
_LARGEST_TURN = 20.0  # rad/s
_NEAR_UNIT_NORM = 1e-3


class PoseTrack:
    """Newest pose of an obstacle from stamped poses, with the velocity between the newest two.

    Args:
        timeout: age [s] from which on the pose counts as lost.
        min_interval: [s] poses closer than this to the one before are passed over.
    """

    def __init__(self, timeout, min_interval):
        self._timeout = timeout
        self._estimator = VelocityEstimator(min_interval, timeout)
        self._stamp = math.nan  # s, of the pose; inf: it holds forever
        self._pose: Any = None  # MovingPose, once there is one

    def hold(self, position, orientation):
        """Take a pose that holds forever."""
        self._stamp, self._pose = math.inf, MovingPose(tuple(position), tuple(orientation))

    def update(self, stamp, position, orientation):
        """Take in a pose.

        Args:
            stamp: [s].
            position: (3,) m.
            orientation: quaternion x, y, z, w.

        Returns:
            Why it is dropped, as a clause; empty if it is used, or not newer than the last one.
        """
        if not all(map(math.isfinite, (stamp, *position, *orientation))):
            return "it is not finite"
        norm = math.sqrt(sum(c * c for c in orientation))
        if abs(norm - 1.0) > _NEAR_UNIT_NORM:
            return f"its quaternion has the norm {norm:.4g}, not 1"
        rotation = self._continued(tuple(c / norm for c in orientation))
        numbers = np.array((*position, *rotation))
        if not self._estimator.update(stamp, numbers):
            return ""
        pose = self._moving(tuple(position), rotation)
        if math.hypot(*pose.linear) > _LARGEST_SPEED or math.hypot(*pose.angular) > _LARGEST_TURN:
            self._estimator.reset()
            self._estimator.update(stamp, numbers)
            pose = MovingPose(pose.translation, pose.rotation)
        self._stamp, self._pose = stamp, pose
        return ""

    def fault(self, now):
        """Why there is no pose at a time [s], as a clause; empty if there is one."""
        if self._pose is None:
            return "no pose yet"
        age = now - self._stamp
        if age > self._timeout:
            return f"no pose for {age:.1f} s"
        if math.isfinite(age) and age < -self._timeout:
            return f"its pose is {-age:.1f} s in the future; synchronise the clocks"
        return ""

    def at(self, now):
        """The MovingPose at a time [s], moved on from the newest one with its velocity."""
        pose = self._pose
        if math.isinf(self._stamp):
            return pose
        ahead = now - self._stamp
        return pose._replace(
            translation=tuple(p + ahead * v for p, v in zip(pose.translation, pose.linear)),
            rotation=multiply(from_vector([ahead * w for w in pose.angular]), pose.rotation),
        )

    def _continued(self, rotation):
        """The one of the rotation's two quaternions that is nearer to the one before."""
        if self._pose is None or sum(a * b for a, b in zip(rotation, self._pose.rotation)) >= 0.0:
            return rotation
        return tuple(-c for c in rotation)

    def _moving(self, position, rotation):
        rates = self._estimator.velocity()
        # dq/dt = (w, 0) q / 2, the product of quaternions
        angular = _vector_part(rates[3:].tolist(), conjugate(rotation))
        return MovingPose(
            position, rotation, tuple(rates[:3].tolist()), tuple(2.0 * c for c in angular)
        )


def _vector_part(a, b):
    """Of the product of two quaternions."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )
