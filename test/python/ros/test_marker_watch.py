"""What a watch for markers tells about nodes that did not draw the state."""

import pytest
from genpy import Time
from std_msgs.msg import Header
from visualization_msgs.msg import Marker, MarkerArray

from deformable_manipulation.ros import marker_watch
from deformable_manipulation.ros.obstacle_markers import DISTANCE_LABELS

STATE = Time(7, 500000000)


@pytest.fixture
def watch(monkeypatch):
    monkeypatch.setattr(marker_watch.rospy, "Subscriber", lambda *arguments, **options: None)
    return marker_watch.MarkerWatch(STATE)


def draw(watch, node, *stamps):
    array = MarkerArray([Marker(header=Header(stamp=stamp)) for stamp in stamps])
    array._connection_header = {"callerid": node}
    watch._count(array)


def test_a_node_has_drawn_the_state_when_it_has_done_so_twice(watch):
    draw(watch, "/a", Time(0), STATE)
    draw(watch, "/b", STATE)
    draw(watch, "/b", Time(0))
    assert watch.missing(["/a", "/b", "/c"]) == ["/a", "/b", "/c"]
    draw(watch, "/a", STATE)
    assert watch.missing(["/a", "/b", "/c"]) == ["/b", "/c"]


def test_what_they_drew_instead(watch):
    draw(watch, "/late", Time(7, 490000000), Time(0))
    draw(watch, "/once", STATE)
    draw(watch, "/empty")
    assert watch.describe(["/late"]) == "/late drew another state, -0.010 s away"
    assert watch.describe(["/once"]) == "/once drew the state, but not again"
    assert watch.describe(["/empty", "/silent"]) == "/empty drew nothing, /silent drew nothing"


def test_the_distance_is_that_of_the_state(watch):
    def draw_label(stamp, action, text):
        label = Marker(header=Header(stamp=stamp), ns=DISTANCE_LABELS, action=action, text=text)
        array = MarkerArray([label])
        array._connection_header = {"callerid": "/assistants"}
        watch._count(array)

    draw_label(Time(7, 490000000), Marker.ADD, "70 mm (limit 50 mm)")
    draw_label(STATE, Marker.DELETE, "")
    assert watch.distance == ""
    draw_label(STATE, Marker.ADD, "52 mm (limit 50 mm)")
    draw_label(Time(0), Marker.ADD, "71 mm (limit 50 mm)")
    assert watch.distance == "52 mm (limit 50 mm)"
