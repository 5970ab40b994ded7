"""What a watch for markers tells about nodes that did not draw the state."""

import pytest
from genpy import Time
from std_msgs.msg import Header
from visualization_msgs.msg import Marker, MarkerArray

from deformable_manipulation.ros import marker_watch

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
