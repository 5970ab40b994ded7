#!/usr/bin/env python3
"""An obstacle whose points come by a topic, and what may be wrong with them."""

import os
import subprocess
import sys

import numpy as np
import seen_floor
from faulty_run import FaultTest
from observed_run import Messages, run_tests
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import PointCloud2

from deformable_manipulation.msg import Distances

CLOSE = 1e-6  # m, of single precision
SEEN = "obstacle 'seen' is lost: "
_OTHER = """
import rospy
from sensor_msgs.msg import PointCloud2
from deformable_manipulation.ros.point_clouds import to_point_cloud
rospy.init_node("other_camera")
publisher = rospy.Publisher("points", PointCloud2, queue_size=1)
while not rospy.is_shutdown():
    publisher.publish(to_point_cloud([(0.0, 0.0, 0.0)] * 20, rospy.Time.now().to_sec(), "map"))
    rospy.sleep(0.05)
"""


class FaultCloudTest(FaultTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.distances = Messages("distances", numpy_msg(Distances))
        cls.decisions.wait_for(
            lambda decision: SEEN + "nothing has come yet on /points" in decision.status_text,
            "the obstacle that is awaited",
        )
        cls.floor = seen_floor.SeenFloor("points")

    def tearDown(self):
        self.floor.spoil = seen_floor.intact

    def test_distances_are_those_from_the_points_where_tf_puts_them(self):
        radius = self.scenario.obstacles[0].radius
        for distances in self.distances.wait_for_more(50):
            places = distances.obstacle_points.reshape(-1, 3)
            self.assertGreater(len(places), 0)
            # On a ball around a point of the floor, the upper half of which the object sees.
            self.assertTrue((places[:, 2] > seen_floor.HEIGHT - CLOSE).all())
            self.assertTrue((places[:, 2] < seen_floor.HEIGHT + radius + CLOSE).all())

    def test_lost(self):
        self.assert_stops_and_goes_on(seen_floor.lost, "nothing that can be used has come for")

    def test_late(self):
        self.assert_stops_and_goes_on(seen_floor.late, log="its stamp is 1.0 s old")

    def test_without_a_stamp(self):
        self.assert_stops_and_goes_on(seen_floor.without_stamp, log="they have no stamp")

    def test_no_numbers(self):
        self.assert_stops_and_goes_on(
            seen_floor.of_no_numbers, log="it has 0 points of which something can be made; 10 at"
        )

    def test_empty(self):
        self.assert_stops_and_goes_on(seen_floor.empty, log="it has 0 points")

    def test_cut_off(self):
        self.assert_stops_and_goes_on(seen_floor.cut_off, log="it is cut off")

    def test_in_a_frame_that_nobody_knows(self):
        self.assert_stops_and_goes_on(
            seen_floor.in_unknown_frame,
            log="frame 'nowhere' cannot be turned into 'map' at the stamp: ",
        )

    def test_two_publishers(self):
        other = subprocess.Popen([sys.executable, "-c", _OTHER], env=os.environ)
        try:
            self.assert_waits(SEEN + "/fault_cloud and /other_camera both send on /points")
        finally:
            other.terminate()
            other.wait()
        self.assert_follows()

    def test_what_is_used_can_be_shown(self):
        used = Messages("points/used", PointCloud2)
        (cloud,) = used.wait_for_more(1)[:1]
        self.assertEqual(cloud.header.frame_id, "map")
        self.assertGreater(cloud.width, 1000)

    def assert_stops_and_goes_on(self, spoil, status="", log=""):
        self.floor.spoil = spoil
        self.assert_waits(SEEN, status, " on /points")
        if log:
            self.assert_says("Obstacle 'seen' ignores data on /points: ", log)
        fault = self.distances.wait_for(lambda each: each.fault, "a fault", len(self.distances) - 1)
        self.assertTrue(np.isnan(fault.minimum_distances).all())
        self.floor.spoil = seen_floor.intact
        self.assert_follows()


if __name__ == "__main__":
    run_tests("fault_cloud")
