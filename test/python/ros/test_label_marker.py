"""Times written where the leader was."""

import numpy as np
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

from deformable_manipulation.ros.label_marker import label_markers, time_labels


def test_where_the_leader_comes_again_one_label_tells_all_times():
    places = np.array([[0.0, 0.5, 1.8], [0.0, 0.7, 0.9], [0.0, 0.51, 1.8], [0.0, 0.0, 1.8]])
    labels = time_labels([30.0, 60.0, 130.0, 160.0], places)
    assert [text for _, text in labels] == ["30, 130 s", "60 s", "160 s"]
    np.testing.assert_array_equal(labels[0][0], places[0])


def test_markers_of_labels():
    nothing, label = label_markers(Header(), [(np.array([1.0, 2.0, 3.0]), "60 s")])
    assert nothing.action == Marker.DELETE
    assert (label.text, label.pose.position.x, label.pose.position.y) == ("60 s", 1.0, 2.0)
    assert label.pose.position.z > 3.0
    (nothing,) = label_markers(Header(), [])  # still a marker, with the stamp of the state
    assert nothing.action == Marker.DELETE
