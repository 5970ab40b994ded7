"""A recording of the package's own rope is replayed by the same rope, and not by another."""

import dataclasses
import json

import numpy as np
import pytest
from rope_recordings import OBJECT, ROPE, SUBSTEPS, record, stiffer

from deformable_manipulation.commands.replay import main
from deformable_manipulation.replaying import replay as replay_module
from deformable_manipulation.replaying.difference import calm_frames, difference
from deformable_manipulation.replaying.measured_shapes import (
    MeasuredShapes,
    MeasuredShapesError,
    read_measured_shapes,
    write_measured_shapes,
)
from deformable_manipulation.replaying.replay import Replay, ReplayOptions


@pytest.fixture(scope="module")
def shapes():
    return record()


def error_of(spec, shapes, **options):
    predicted = Replay(spec, shapes, ReplayOptions(substeps=SUBSTEPS, **options)).run(spec)
    return difference(shapes, predicted).numbers


def test_the_same_rope_is_replayed(shapes):
    # The first shape lies on a spline through nine points; from rest it is exact.
    assert error_of(ROPE, shapes)["mean_distance"] < 2e-3
    assert error_of(ROPE, shapes, start="settled")["worst_distance"] < 1e-4


def test_a_rope_between_grippers_of_a_width_is_replayed_with_these():
    """Each gripper holds two points, at its edges and a little beyond."""
    last = ROPE.segments - 1
    gripped = ROPE.held_by([(0, 0.02), (last, 0.02)])
    shapes = record(gripped, frames=60)
    assert error_of(gripped, shapes, start="settled")["worst_distance"] < 1e-4
    assert error_of(ROPE, shapes, start="settled")["worst_distance"] > 2e-3


def test_another_rope_is_not(shapes):
    assert error_of(stiffer(ROPE, 3.0), shapes, start="settled")["mean_distance"] > 5e-3


def test_points_that_were_not_seen_are_left_out(shapes):
    points = shapes.points.copy()
    points[40:60, 3] = np.nan
    some = MeasuredShapes(shapes.time, shapes.places, points)
    assert error_of(ROPE, some, start="settled")["worst_distance"] < 1e-4


def test_a_recording_may_have_gaps_in_time(shapes):
    kept = np.r_[0:50, 55:150]
    some = MeasuredShapes(shapes.time[kept], shapes.places, shapes.points[kept])
    assert error_of(ROPE, some, start="settled")["mean_distance"] < 2e-3


def paused(shapes, pause):
    """A recording whose second half was measured after a pause [s]."""
    time = shapes.time + np.where(np.arange(len(shapes.time)) < 75, 0.0, pause)
    return MeasuredShapes(time, shapes.places, shapes.points)


def test_a_long_gap_is_replayed_in_short_steps(shapes):
    calls = []

    class Body:
        def __init__(self, body):
            self._body = body

        def __getattr__(self, name):
            return getattr(self._body, name)

        def step(self, time_step, substeps):
            calls.append((time_step, substeps))
            self._body.step(time_step, substeps)

    with pytest.MonkeyPatch.context() as patch:
        make = replay_module.make_body
        patch.setattr(replay_module, "make_body", lambda *given: Body(make(*given)))
        assert np.isfinite(error_of(ROPE, paused(shapes, 2.99))["mean_distance"])
    steps, substeps = zip(*calls)
    assert sum(steps) == pytest.approx(shapes.time[-1] + 2.99)
    assert max(steps) == pytest.approx(0.1)
    assert max(substeps) == 10 * SUBSTEPS


def test_a_gap_that_would_take_for_ever_is_refused(shapes):
    mistake = r"nothing was measured from 0.74 to 1e\+06 s; a gap is at most 60 s long: cut"
    with pytest.raises(MeasuredShapesError, match=mistake):
        Replay(ROPE, paused(shapes, 1e6), ReplayOptions())


def test_a_grip_may_hold_the_object_at_an_angle(shapes):
    replay = Replay(ROPE, shapes, ReplayOptions(start="settled", substeps=SUBSTEPS))
    straight = replay.run(ROPE)
    aimed = replay.run(ROPE, [(0.2, 0.0), (0.0, 0.0)])
    assert np.linalg.norm(aimed - straight, axis=2)[0].max() > 0.01
    np.testing.assert_allclose(replay.run(ROPE, [(0.0, 0.0)] * 2), straight, atol=1e-9)


def test_a_single_point_is_pinned(shapes):
    replay = Replay(ROPE, shapes, ReplayOptions(held=((0, 1), (7,)), start="settled"))
    assert [grip.hold for grip in replay.grips] == ["clamped", "pinned"]
    assert np.isfinite(replay.run(ROPE)).all()


def test_rest_is_told_from_motion(shapes):
    calm = calm_frames(shapes)
    assert not calm[:49].any()
    assert not calm[60:].any()
    quiet = MeasuredShapes(shapes.time, shapes.places, 0 * shapes.points)
    assert calm_frames(quiet)[51:].all()


@pytest.mark.parametrize(
    "options, mistake",
    [
        ({"held": ((0, 9),)}, "point 9 cannot be held: there are points 0 to 8"),
        ({"held": ((0, 1), (0,))}, "point 0 is held by grippers 1 and 2 .* one gripper; leave it"),
        ({"held": ((0, 1, 2), (2, 3), (7, 8))}, "point 2 is held by grippers 1 and 2"),
    ],
)
def test_wrong_grips_are_refused(shapes, options, mistake):
    with pytest.raises(MeasuredShapesError, match=mistake):
        Replay(ROPE, shapes, ReplayOptions(**options))


def test_two_points_make_a_straight_rope(shapes):
    few = MeasuredShapes(shapes.time, shapes.places[[0, 4]], shapes.points[:, [0, 4]])
    replay = Replay(ROPE, few, ReplayOptions(held=((0,), (1,))))
    start = replay._start[0]
    assert np.linalg.norm(start[-1] - few.points[0, 1]) > 0.3  # it goes on beyond the last point
    assert np.linalg.norm(np.diff(start, 2, axis=0), axis=1).max() < 1e-12
    assert np.isfinite(replay.run(ROPE)).all()


def test_points_at_the_same_place_are_refused(shapes):
    for frame, mistake in ((0, "points 7 and 8 are at .* first shape"), (60, "at 0.6 s")):
        points = shapes.points.copy()
        points[frame, 8] = points[frame, 7]
        same = MeasuredShapes(shapes.time, shapes.places, points)
        with pytest.raises(MeasuredShapesError, match=mistake):
            Replay(ROPE, same, ReplayOptions())


def test_an_object_too_coarse_for_its_grips_is_refused(shapes):
    coarse = dataclasses.replace(ROPE, segments=2)
    with pytest.raises(MeasuredShapesError, match="two grippers hold segment 0: use more segments"):
        Replay(coarse, shapes, ReplayOptions(held=((0, 1), (2, 3))))


class TestCommand:
    @pytest.fixture
    def files(self, tmp_path, shapes):
        write_measured_shapes(tmp_path / "swing.csv", shapes)
        (tmp_path / "rope.yaml").write_text(OBJECT)
        return tmp_path

    def run(self, files, *more):
        given = [str(files / "swing.csv"), "--object", str(files / "rope.yaml")]
        return main([*given, "--output", str(files / "out"), *more])

    def test_writes_numbers_points_and_a_figure(self, files, capsys, shapes):
        assert self.run(files, "--begin", "settled") == 0
        assert "mean distance            0.0 mm" in capsys.readouterr().out
        numbers = json.loads((files / "out" / "difference.json").read_text())
        assert numbers["mean_per_coordinate"] < 1e-4
        assert numbers["mean_distance_at_rest"] is None
        predicted = read_measured_shapes(files / "out" / "predicted.csv")
        np.testing.assert_allclose(predicted.points, shapes.points, atol=1e-4)
        assert (files / "out" / "replay.png").stat().st_size > 10000

    def test_takes_a_part_and_other_values(self, files, capsys):
        assert self.run(files, "--from", "0.5", "--to", "1", "--set", "object.damping=20") == 0
        predicted = read_measured_shapes(files / "out" / "predicted.csv")
        assert predicted.time[[0, -1]] == pytest.approx((0.5, 1.0))

    @pytest.mark.parametrize(
        "more, mistake",
        [
            (["--set", "object.length=0.5"], "the last point is at 1 m, but the object is 0.5 m"),
            (["--set", "object.damping=-1"], "object.damping"),
            (["--set", "object.type=fabric"], "object"),
            (["--from", "7"], "fewer than two shapes"),
        ],
    )
    def test_tells_what_is_wrong(self, files, capsys, more, mistake):
        assert self.run(files, *more) == 1
        assert mistake in capsys.readouterr().err

    def test_warns_of_too_few_substeps(self, files, capsys):
        assert self.run(files, "--set", "object.torsion_modulus=1e3") == 0
        assert "replay: WARNING: object.torsion_modulus" in capsys.readouterr().err

    def test_refuses_a_list_of_points_out_of_order(self, files, capsys):
        with pytest.raises(SystemExit):
            self.run(files, "--held", "1,0")
        assert "must be numbers of points in their order" in capsys.readouterr().err
