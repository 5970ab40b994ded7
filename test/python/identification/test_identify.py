"""Parameters of the package's own rope are found again from recordings of it."""

import dataclasses
import json
import math

import numpy as np
import pytest
import yaml
from rope_recordings import OBJECT, ROPE, SUBSTEPS, record

from deformable_manipulation.commands.identify import FITTED, main
from deformable_manipulation.commands.replay import main as replay
from deformable_manipulation.identification.findings import object_section, statements, values
from deformable_manipulation.identification.identify import Identification, identify
from deformable_manipulation.identification.least_squares import Fit, fit
from deformable_manipulation.identification.parameters import (
    AIM,
    CURVATURE,
    MATERIAL,
    Parameters,
)
from deformable_manipulation.identification.problem import Problem, windows_of
from deformable_manipulation.identification.workers import worker_map
from deformable_manipulation.objects.natural_shape import NaturalShape
from deformable_manipulation.replaying.measured_shapes import (
    MeasuredShapes,
    MeasuredShapesError,
    write_measured_shapes,
)
from deformable_manipulation.replaying.replay import ReplayOptions

GUESS = dataclasses.replace(
    ROPE, young_modulus=1e8, torsion_modulus=3.5e7, bending_retardation_time=0.2
)
OPTIONS = ReplayOptions(substeps=SUBSTEPS, start="settled")


@pytest.fixture(scope="module")
def recording():
    return record(noise=5e-4)


def parameters_of(*material, grips=0):
    return Parameters(GUESS, material, grips)


def test_windows_too_short_for_three_shapes_are_an_error(recording):
    with pytest.raises(MeasuredShapesError, match="no window of 0.001 s has three shapes"):
        windows_of([recording], parameters_of("young_modulus"), OPTIONS, 0.001)


def test_time_in_which_nothing_was_measured_is_no_window(recording):
    """Of a pause of a million windows, none is looked at."""
    time = np.concatenate((recording.time, recording.time + 1e6))
    points = np.concatenate((recording.points, recording.points))
    paused = MeasuredShapes(time, recording.places, points)
    windows = windows_of([paused], parameters_of("young_modulus"), OPTIONS, 0.5)
    assert [round(each.replay.shapes.time[0], 2) for each in windows[:3]] == [0.0, 0.5, 1.0]
    assert 4 <= len(windows) <= 6


def test_stiffness_and_viscosity_are_found_from_afar(recording):
    parameters = parameters_of("young_modulus", "bending_retardation_time")
    windows = windows_of([recording], parameters, OPTIONS, 1.49)
    fractions = []
    found = identify(parameters, windows, 0, fractions.append)
    spec = parameters.object_of(found.fit.vector)
    assert spec.young_modulus == pytest.approx(ROPE.young_modulus, rel=0.05)
    assert spec.torsion_modulus == pytest.approx(0.35 * spec.young_modulus)
    assert spec.bending_retardation_time == pytest.approx(0.05, rel=0.1)
    assert found.fit.converged
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert min(found.torsion) > 0.1  # the rope is twisted as it swings: the guess is right
    assert found.left_out is None


def test_leaps_of_a_few_points_do_not_matter(recording):
    points = recording.points.copy()
    points[::7, 4] += 0.3
    points[50:60, 3] = np.nan
    broken = MeasuredShapes(recording.time, recording.places, points)
    parameters = parameters_of("young_modulus")
    spec = dataclasses.replace(GUESS, bending_retardation_time=0.05)
    parameters = dataclasses.replace(parameters, spec=spec)
    found = identify(parameters, windows_of([broken], parameters, OPTIONS, 1.49), 0)
    assert math.exp(found.fit.vector[0]) == pytest.approx(ROPE.young_modulus, rel=0.1)


def test_the_aim_of_a_grip_is_found(recording):
    spec = dataclasses.replace(ROPE)
    parameters = Parameters(spec, (), 2)
    window = windows_of([recording], parameters, OPTIONS, 1.49)[0]
    turned = window.replay.run(spec, [(0.1, 0.0), (0.0, -0.05)])
    aimed = MeasuredShapes(recording.time, recording.places, turned)
    # The held points are those of the recording: the grips move as before.
    held = recording.points[:, [0, 1, -2, -1]]
    aimed.points[:, [0, 1, -2, -1]] = held
    found = fit(Problem(parameters, windows_of([aimed], parameters, OPTIONS, 1.49)), np.zeros(4), 8)
    np.testing.assert_allclose(found.vector, (0.1, 0.0, 0.0, -0.05), atol=0.005)


def test_deviations_cover_the_error():
    parameters = Parameters(ROPE, ("young_modulus",), 0)
    recordings = [record(noise=2e-3, seed=seed, frames=100) for seed in range(4)]
    windows = windows_of(recordings, parameters, OPTIONS, 0.49)
    found = fit(Problem(parameters, windows), parameters.start(), 8)
    assert abs(found.vector[0] - math.log(ROPE.young_modulus)) < 4.0 * found.deviations[0]
    assert 1e-5 < found.deviations[0] < 0.2


def test_what_the_object_lacks_is_found():
    dragged = dataclasses.replace(ROPE, drag_coefficient=20.0, density=300.0)
    parameters = Parameters(
        dataclasses.replace(dragged, drag_coefficient=0.0), ("drag_coefficient",), 0
    )
    windows = windows_of([record(dragged)], parameters, OPTIONS, 1.49)
    found = fit(Problem(parameters, windows), parameters.start(), 12)
    assert math.exp(found.vector[0]) == pytest.approx(20.0, rel=0.02)


class TestCurvature:
    """Between two clamps a uniform curvature in the plane of the rope changes nothing."""

    options = dataclasses.replace(OPTIONS, held=((0, 1), (8,)))  # the second grip pins it

    def found(self, recording, spec):
        window = windows_of([recording], Parameters(ROPE, (), 0), self.options, 1.49)[0]
        points = window.replay.run(spec)
        points[:, [0, 1, 8]] = recording.points[: len(points), [0, 1, 8]]  # grips move as before
        shapes = MeasuredShapes(window.replay.shapes.time, recording.places, points)
        parameters = Parameters(ROPE, (), 0, curved=True)
        return identify(parameters, windows_of([shapes], parameters, self.options, 1.49), 0)

    def test_is_found(self, recording):
        curvature = (0.5, -0.3)
        coiled = dataclasses.replace(ROPE, natural_shape=NaturalShape(curvature=curvature))
        found = self.found(recording, coiled)
        np.testing.assert_allclose(found.fit.vector, curvature, atol=0.05)
        assert found.straight > 1.0
        assert [row[0] for row in values(found)] == [f"natural curvature about {a}" for a in "yz"]
        assert any("keep it" in sentence for sentence in statements(found))
        section = yaml.safe_load(object_section(found))["object"]
        assert section["natural_shape"]["curvature"] == pytest.approx(found.fit.vector)

    def test_of_a_straight_rope_is_none(self, recording):
        found = self.found(recording, ROPE)
        np.testing.assert_allclose(found.fit.vector, 0.0, atol=0.02)


def test_a_curvature_that_does_not_matter_is_said_to_be_none(recording):
    parameters = Parameters(ROPE, (), 0, curved=True)
    found = identify(parameters, windows_of([recording], parameters, OPTIONS, 1.49), 0)
    assert any("as good as straight" in sentence for sentence in statements(found))


def test_processes_find_the_same(recording):
    parameters = parameters_of("young_modulus")
    windows = windows_of([recording], parameters, OPTIONS, 0.49)
    alone = Problem(parameters, windows).residuals(parameters.start())
    with worker_map(2) as each:
        together = Problem(parameters, windows, each=each).residuals(parameters.start())
    for one, other in zip(alone, together):
        np.testing.assert_array_equal(one, other)


def test_a_window_that_is_left_over_is_not_used(recording):
    parameters = parameters_of("young_modulus")
    assert len(windows_of([recording, recording], parameters, OPTIONS, 0.6)) == 4
    assert len(windows_of([recording], parameters, OPTIONS, 10.0)) == 1


def test_a_value_at_the_bound_of_the_search_is_no_result():
    parameters = parameters_of("young_modulus", "drag_coefficient", grips=1)
    vector = parameters.bounded(np.array((math.log(1e7), math.log(1e6), 0.1, -2.0)))
    assert parameters.at_bounds(vector).tolist() == [False, True, False, True]
    found = Identification(
        parameters, Fit(vector, np.array((0.01, 0.2, 0.02, 0.02)), True), {}, (0.0, 0.0), None
    )
    assert [row[1:] for row in values(found)] == [
        ["1e+07 Pa", "+- 1.0 %"],
        ["100", "at the bound of the search"],
        ["5.73 deg", "+- 1.15 deg"],
        ["-45.00 deg", "at the bound of the search"],
    ]
    text = "\n".join(statements(found))
    assert "The value of drag_coefficient, 100, is the bound of the search and no result" in text
    assert "#   drag_coefficient: 100 at the bound of the search" in object_section(found)


def test_the_command_names_what_can_be_fitted():
    assert FITTED["rod"] == (*MATERIAL, CURVATURE, AIM)


class TestCommand:
    @pytest.fixture
    def files(self, tmp_path_factory):
        folder = tmp_path_factory.mktemp("identify")
        for seed in (1, 2, 3):
            shapes = record(noise=5e-4, seed=seed, frames=100)
            write_measured_shapes(folder / f"swing_{seed}.csv", shapes)
        (folder / "rope.yaml").write_text(OBJECT.replace("2.0e+7", "6.0e+7"))
        return folder

    def test_writes_an_object_that_can_be_replayed(self, files, capsys):
        recordings = [str(files / f"swing_{seed}.csv") for seed in (1, 2, 3)]
        given = ["--object", str(files / "rope.yaml"), "--output", str(files / "out")]
        assert main([*recordings, *given, "--fit", "young_modulus"]) == 0
        text = capsys.readouterr().out
        assert "young_modulus" in text
        assert "E I / (rho A)" in text
        assert "Cross-validation" in text
        section = yaml.safe_load((files / "out" / "object.yaml").read_text())["object"]
        assert section["young_modulus"] == pytest.approx(ROPE.young_modulus, rel=0.1)
        numbers = json.loads((files / "out" / "identification.json").read_text())
        assert numbers["parameters"] == ["young_modulus"]
        assert "# Identification" in (files / "out" / "report.md").read_text()
        replayed = ["--object", str(files / "out" / "object.yaml"), "--output", str(files / "out")]
        assert replay([recordings[0], *replayed, "--aim=0,0", "--aim=0,0"]) == 0

    @pytest.mark.parametrize(
        "more, mistake",
        [
            (["--fit", "colour"], "must be some of young_modulus"),
            (["--fit", "aim,aim"], "must be some of young_modulus"),
            (["--window", "0"], "must be a number > 0 [s]"),
            (["--workers", "0"], "must be a whole number >= 1"),
            (["--folds", "-1"], "must be a whole number >= 0"),
        ],
    )
    def test_refuses_wrong_usage(self, capsys, more, mistake):
        with pytest.raises(SystemExit):
            main(["swing.csv", "--object", "rope.yaml", *more])
        assert mistake in capsys.readouterr().err

    def test_tells_what_is_wrong_with_a_recording(self, files, capsys):
        given = ["--object", str(files / "rope.yaml"), "--output", str(files / "out")]
        assert main([str(files / "absent.csv"), *given]) == 1
        assert "absent.csv" in capsys.readouterr().err
