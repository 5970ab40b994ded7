"""Parameters of the package's own sheet are found again from a recording of it."""

import pytest
import yaml
from fabric_recordings import HELD, OBJECT, SUBSTEPS, record, sheet

from deformable_manipulation.commands.identify import FITTED, main
from deformable_manipulation.identification.findings import statements, values
from deformable_manipulation.identification.identify import identify
from deformable_manipulation.identification.material_parameters import (
    OF_FABRICS,
    MaterialParameters,
)
from deformable_manipulation.identification.problem import windows_of
from deformable_manipulation.replaying.measured_shapes import write_measured_shapes
from deformable_manipulation.replaying.replay import ReplayOptions


def test_bending_and_damping_are_found_from_afar():
    guess = sheet(bending_compliance=20000.0, damping=8.0)
    parameters = MaterialParameters(guess, ("bending_compliance", "damping"))
    options = ReplayOptions(held=HELD, substeps=SUBSTEPS)
    windows = windows_of([record(noise=5e-4)], parameters, options, 0.39)
    found = identify(parameters, windows, 0)
    spec = parameters.object_of(found.fit.vector)
    assert spec.bending_compliance == pytest.approx(2000.0, rel=0.2)
    assert spec.damping == pytest.approx(2.0, rel=0.1)
    assert spec.stretching_compliance == guess.stretching_compliance
    assert found.torsion is None
    assert values(found)[0][1].endswith("1/(N m)")
    said = " ".join(statements(found))
    assert "products of compliances and mass only" in said
    assert "torsion" not in said


def test_the_command_identifies_a_fabric(tmp_path, capsys):
    write_measured_shapes(tmp_path / "sheet.csv", record())
    (tmp_path / "sheet.yaml").write_text(OBJECT.replace("damping: 2.0", "damping: 6.0"))
    given = [str(tmp_path / "sheet.csv"), "--object", str(tmp_path / "sheet.yaml")]
    given += ["--held", "0", "--held", "2", "--window", "0.5", "--workers", "1"]
    assert main([*given, "--fit", "damping", "--output", str(tmp_path / "out")]) == 0
    found = yaml.safe_load((tmp_path / "out" / "object.yaml").read_text())["object"]
    assert found["damping"] == pytest.approx(2.0, rel=0.1)
    assert len(found["mesh"]["vertices"]) == 63
    assert main([*given, "--fit", "young_modulus,damping"]) == 1
    assert "--fit young_modulus: the object is a fabric, of which" in capsys.readouterr().err


def test_the_command_names_what_can_be_fitted():
    assert FITTED["fabric"] == OF_FABRICS
