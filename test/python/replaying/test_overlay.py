"""What RViz shows of a replay, read back from its bag."""

import numpy as np
import pytest
import yaml
from fabric_recordings import HELD, SUBSTEPS, record, sheet
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore

from deformable_manipulation.replaying.measured_shapes import MeasuredShapes
from deformable_manipulation.replaying.overlay import (
    Overlay,
    overlay_configuration,
    write_overlay_bag,
)
from deformable_manipulation.replaying.replay import Replay, ReplayOptions


@pytest.fixture(scope="module")
def overlay():
    shapes = record(frames=30)
    points = shapes.points.copy()
    points[:, 4] = np.nan
    spec = sheet()
    whole = Replay(spec, shapes, ReplayOptions(held=HELD, substeps=SUBSTEPS)).run_whole(spec)
    predicted = points + 0.01
    seen = MeasuredShapes(shapes.time, shapes.places, points)
    return Overlay(seen, np.nan_to_num(predicted), whole, spec.edges()[0])


def messages_of(path):
    types = get_typestore(Stores.ROS1_NOETIC)
    with Reader(path) as bag:
        for connection, stamp, data in bag.messages():
            assert connection.topic == "/markers"
            yield stamp, types.deserialize_ros1(data, connection.msgtype)


def test_both_shapes_are_in_the_bag(tmp_path, overlay):
    write_overlay_bag(tmp_path / "replay.bag", overlay)
    write_overlay_bag(tmp_path / "replay.bag", overlay)  # again: the first one is replaced
    stamps, arrays = zip(*messages_of(tmp_path / "replay.bag"))
    assert len(stamps) == 8  # of 30 shapes in 0.29 s, 30 per second at most
    np.testing.assert_allclose(np.diff(stamps), 0.04e9)
    first = {marker.ns: marker for marker in arrays[0].markers}
    counts = {name: len(marker.points) for name, marker in first.items()}
    edges = len(overlay.edges)
    assert counts == {"measured": 8, "predicted": 9, "difference": 16, "object": 2 * edges}
    place = first["measured"].points[0]
    assert (place.x, place.y, place.z) == pytest.approx(tuple(overlay.shapes.points[0, 0]))
    line = [(p.x, p.y, p.z) for p in first["object"].points[:2]]
    np.testing.assert_allclose(line, overlay.whole[0][overlay.edges[0]])
    assert {marker.header.frame_id for marker in first.values()} == {"map"}


def test_the_view_holds_all_points(overlay):
    manager = yaml.safe_load(overlay_configuration(overlay))["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == "map"
    assert [each["Class"] for each in manager["Displays"]] == ["rviz/Grid", "rviz/MarkerArray"]
    centre = manager["Views"]["Current"]["Focal Point"]
    points = overlay.whole.reshape(-1, 3)
    assert points.min(axis=0)[2] < centre["Z"] < points.max(axis=0)[2]
