"""What the tests of obstacles whose pose comes from outside have in common.

The ground of the run rises slowly below a rope that hangs well above it.
"""

import numpy as np
from faulty_run import FaultTest
from observed_run import Messages
from rospy.numpy_msg import numpy_msg
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray
from walking_pose import intact, lost

from deformable_manipulation.control.status import Status
from deformable_manipulation.msg import Distances

START = (0.0, 0.0, -0.5)  # m
VELOCITY = (0.002, 0.0, 0.004)  # m/s
CLOSE = 1e-3  # m, m/s: stamps of a busy machine


class TrackedObstacleTest(FaultTest):
    """To be imported by its module: a name of its own in a program would be run there.

    Its setting up finds the assistant waiting until the obstacle is seen.

    Attributes:
        origin: where the poses come from, in the words of the status.
    """

    @classmethod
    def start_obstacle(cls):
        """The WalkingPose."""
        raise NotImplementedError

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.distances = Messages("distances", numpy_msg(Distances))
        cls.wait_for_status(f"obstacle 'ground' is lost: no pose yet {cls.origin}")
        cls.obstacle = cls.start_obstacle()

    @classmethod
    def wait_for_status(cls, words):
        cls.decisions.wait_for(
            lambda decision: decision.status == Status.WAITING and words in decision.status_text,
            words,
            len(cls.decisions),
        )

    def tearDown(self):
        self.obstacle.spoil = intact

    def test_the_obstacle_is_where_its_pose_says_with_its_velocity(self):
        for distances in self.distances.wait_for_more(50):
            self.assertEqual(distances.moving_obstacles, ["ground"])
            position = distances.obstacle_poses[:3]
            expected = self.obstacle.position(distances.header.stamp)
            np.testing.assert_allclose(position, expected, 0.0, CLOSE)
        velocities = [each.obstacle_velocities.reshape(-1, 3) for each in self.distances[-50:]]
        np.testing.assert_allclose(np.concatenate(velocities).mean(axis=0), VELOCITY, 0.0, CLOSE)

    def test_rviz_gets_its_surface_once_in_a_while_and_a_frame_that_follows(self):
        transforms, markers = Messages("/tf", TFMessage), Messages("markers", MarkerArray)
        array = markers.wait_for(
            lambda each: each.markers[0].ns == "moving_obstacles", "the obstacle", len(markers)
        )
        (marker,) = array.markers
        self.assertTrue(marker.frame_locked)
        message = transforms.wait_for(
            lambda each: each.transforms[0].child_frame_id == marker.header.frame_id, "its frame"
        )
        (found,) = message.transforms
        place = found.transform.translation
        expected = self.obstacle.position(found.header.stamp)
        np.testing.assert_allclose([place.x, place.y, place.z], expected, 0.0, CLOSE)

    def test_lost(self):
        self.assert_stops_and_goes_on(lost, "obstacle 'ground' is lost: no pose for")

    def assert_stops_and_goes_on(self, spoil, *status, log=()):
        self.obstacle.spoil = spoil
        self.assert_waits(*status, self.origin)
        fault = self.distances.wait_for(lambda each: each.fault, "a fault", len(self.distances) - 1)
        self.assertTrue(np.isnan(fault.minimum_distances).all())
        self.assertEqual(len(fault.feature_distances), 0)
        if log:
            self.assert_says(*log)
        self.obstacle.spoil = intact
        self.assert_follows()
