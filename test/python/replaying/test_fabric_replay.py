"""A recording of the package's own sheet is replayed by the same sheet, and not by another."""

import dataclasses
import json

import numpy as np
import pytest
from fabric_recordings import HELD, OBJECT, SUBSTEPS, record, sheet
from rope_recordings import ROPE
from rope_recordings import record as record_rope

from deformable_manipulation.commands.replay import main
from deformable_manipulation.replaying.difference import difference
from deformable_manipulation.replaying.measured_shapes import (
    MeasuredShapes,
    MeasuredShapesError,
    read_measured_shapes,
    write_measured_shapes,
)
from deformable_manipulation.replaying.replay import Replay, ReplayOptions

OPTIONS = ReplayOptions(held=HELD, substeps=SUBSTEPS)


@pytest.fixture(scope="module")
def shapes():
    return record()


def error_of(spec, shapes, **options):
    replay = Replay(spec, shapes, dataclasses.replace(OPTIONS, **options))
    return difference(shapes, replay.run(spec)).numbers


def at(shapes, places):
    return MeasuredShapes(shapes.time, np.array(places), shapes.points[:, : len(places)])


def test_the_same_sheet_is_replayed(shapes):
    assert error_of(sheet(), shapes, start="settled")["worst_distance"] < 1e-3
    # Between nine points the first shape is a guess.
    assert error_of(sheet(), shapes)["mean_distance"] < 2e-3


def test_another_sheet_is_not(shapes):
    for other in (sheet(bending_compliance=500.0), sheet(damping=8.0)):
        assert error_of(other, shapes, start="settled")["mean_distance"] > 3e-3


def test_measured_points_need_not_be_vertices(shapes):
    """The middle of a triangle's side moves as the mean of its ends."""
    spec = sheet()
    replay = Replay(spec, shapes, OPTIONS)
    places = np.vstack((shapes.places, (0.025, 0.0)))
    points = np.concatenate((shapes.points, shapes.points[:, :1]), axis=1)
    between = Replay(spec, MeasuredShapes(shapes.time, places, points), OPTIONS)
    vertices = np.random.default_rng(1).standard_normal((spec.particles, 3))
    found = between._driven.measured(vertices)
    np.testing.assert_allclose(found[:-1], replay._driven.measured(vertices), atol=1e-12)
    np.testing.assert_allclose(found[-1], 0.5 * (vertices[0] + vertices[1]), atol=1e-12)


def test_a_curved_mesh_has_points_with_three_coordinates():
    spec = sheet()
    vertices = np.array(spec.vertices)
    vertices[:, 2] = 0.1 * np.cos(10.0 * vertices[:, 0])
    bowed = dataclasses.replace(spec, vertices=tuple(map(tuple, vertices)))
    numbers = [0, 4, 8, 27, 31, 35, 54, 58, 62]
    moved = vertices[None, numbers] + np.array([0.0, 0.01, 0.02])[:, None, None]
    shapes = MeasuredShapes(np.array([0.0, 0.01, 0.02]), vertices[numbers], moved)
    replay = Replay(bowed, shapes, OPTIONS)
    np.testing.assert_allclose(replay._start[0], vertices, atol=0.02)
    np.testing.assert_allclose(replay._start[1], 1.0, atol=1e-6)


def test_recordings_of_fabrics_survive_their_file(tmp_path, shapes):
    write_measured_shapes(tmp_path / "sheet.csv", shapes)
    found = read_measured_shapes(tmp_path / "sheet.csv")
    np.testing.assert_allclose(found.places, shapes.places)
    np.testing.assert_allclose(found.points, shapes.points, atol=1e-6)


@pytest.mark.parametrize(
    "header, mistake",
    [
        ("time,x@0,y@0,z@0,x@0/1,y@0/1,z@0/1", "column 5 has 2 coordinates, the point before 1"),
        ("time,x@0/0,y@0/0,z@0/0,x@0/0,y@0/0,z@0/0", "column 5 is at the place of column 2, 0/0"),
        ("time,x@0/0/0/0,y@0/0/0/0,z@0/0/0/0,x@1,y@1,z@1", "columns 2 to 4 must be named"),
        ("time,x@0/a,y@0/a,z@0/a,x@1/0,y@1/0,z@1/0", "columns 2 to 4 must be named"),
    ],
)
def test_wrong_columns_are_refused(tmp_path, header, mistake):
    (tmp_path / "sheet.csv").write_text(f"{header}\n0,0,0,0,1,1,1\n1,0,0,0,1,1,1\n")
    with pytest.raises(MeasuredShapesError, match=mistake):
        read_measured_shapes(tmp_path / "sheet.csv")


def test_what_does_not_fit_a_fabric_is_refused(shapes):
    line = [(0.0, 0.0), (0.2, 0.0), (0.4, 0.0), (0.1, 0.0)]
    beside = np.vstack((shapes.places[:-1], (0.5, 0.3)))
    between = np.vstack(((0.02, 0.0), shapes.places[1:]))
    for spec, wrong, options, mistake in (
        (sheet(), shapes, {"held": None}, "say which points are held"),
        (sheet(), shapes, {"aim": ((0.1, 0.0),) * 2}, "a gripper pins a fabric: leave out --aim"),
        (sheet(), at(shapes, line), {}, "lie on a line of the undeformed fabric"),
        (sheet(), at(shapes, beside), {}, r"the point at 0.5/0.3/0 m is 0.1 m beside"),
        (sheet(), at(shapes, between), {}, r"lies 20 mm from the nearest vertex, at 0/0/0 m"),
        (sheet(), record_rope(), {}, "of a rod .x@S., but the object is a fabric"),
        (ROPE, shapes, {}, "of a fabric .x@X/Y., but the object is a rod"),
    ):
        with pytest.raises(MeasuredShapesError, match=mistake):
            Replay(spec, wrong, dataclasses.replace(OPTIONS, **options))


def test_the_command_replays_a_fabric(tmp_path, shapes, capsys):
    write_measured_shapes(tmp_path / "sheet.csv", shapes)
    (tmp_path / "sheet.yaml").write_text(OBJECT)
    given = [str(tmp_path / "sheet.csv"), "--object", str(tmp_path / "sheet.yaml")]
    held = ["--held", "0", "--held", "2", "--begin", "settled"]
    assert main([*given, *held, "--output", str(tmp_path / "out")]) == 0
    found = json.loads((tmp_path / "out" / "difference.json").read_text())
    assert found["mean_distance"] < 1e-3
    assert (tmp_path / "out" / "replay.png").exists()
    assert main(given) == 1
    assert "say which points are held" in capsys.readouterr().err
