#!/usr/bin/env python3
"""Measured points of the object correct the states of the simulator.

The test publishes the points: those of the simulated rope, displaced.
"""

import unittest

import numpy as np
import rospy
from observed_run import Messages, observe_states, poll, run_tests
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import String

from deformable_manipulation.ros.conversions import points_of

SAG = 0.03  # m, by which the true rope hangs lower in the middle
AGREE = "measured points that agree with the model of the object"


def model_points(state):
    return points_of(state)[0] - np.reshape(state.correction, (-1, 3))


def cloud_of(points, frame="map", stamp=None):
    """An unordered cloud of points (K, 3) [m] that is seen now."""
    cloud = PointCloud2(height=1, width=len(points), point_step=12, row_step=12 * len(points))
    cloud.header.frame_id = frame
    cloud.header.stamp = stamp or rospy.Time.now()
    cloud.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
    cloud.data = np.asarray(points, dtype=np.float32).tobytes()
    return cloud


class MeasuredPointsTest(unittest.TestCase):
    def test_points_correct_the_object_and_bad_ones_do_not(self):
        states = observe_states()
        waiting = Messages("waiting_for", String)
        publisher = rospy.Publisher("measured_points", PointCloud2, queue_size=1)
        first = states.wait_for(lambda state: True, "a state")
        rest = model_points(first)
        self.assertEqual(len(first.correction), 3 * first.point_count)
        part = np.linspace(0.0, 1.0, len(rest))
        true = rest - np.outer(SAG * np.sin(np.pi * part) ** 2, (0.0, 0.0, 1.0))
        dense = np.stack([np.interp(np.linspace(0, 1, 80), part, axis) for axis in true.T], axis=1)

        def lowest():
            return points_of(states[-1])[0][:, 2].min()

        def publish_until(points, condition, what, **options):
            """Show the points again and again until the condition holds."""

            def shown():
                publisher.publish(cloud_of(points, **options))
                return condition()

            poll(shown, what)

        def publish_for(cycles, points, **options):
            end = states[-1].cycle + cycles
            publish_until(points, lambda: states[-1].cycle > end, "later states", **options)

        publish_until(
            dense, lambda: abs(lowest() - true[:, 2].min()) < 0.005, "points where they are seen"
        )
        np.testing.assert_allclose(model_points(states[-1]), rest, atol=1e-3)

        there = rest[:, 2].min() - lowest()
        lower = dense - (0.0, 0.0, 0.02)
        old = rospy.Time.now() - rospy.Duration(5.0)
        publish_for(70, lower, frame="camera")
        publish_for(70, lower, stamp=old)
        publish_for(70, np.full((5, 3), np.nan))
        self.assertLess(rest[:, 2].min() - lowest(), 0.8 * there, "it does not fade")

        def waits():
            return bool(waiting) and AGREE in waiting[-1].data

        publish_until(dense + (0.0, 0.0, 0.4), waits, "disagreement")
        publish_until(dense, lambda: not waits(), "agreement")
        last = states[-1].cycle
        states.wait_for(lambda state: state.cycle > last, "a state after that")


if __name__ == "__main__":
    run_tests("measured_points")
