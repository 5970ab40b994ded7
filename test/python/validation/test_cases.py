"""Every case of the validation, at its quick settings, within its tolerance."""

import pytest

from deformable_manipulation import _pbd
from deformable_manipulation.validation.cases import CASES


@pytest.mark.parametrize("name", list(CASES))
def test_all_comparisons_are_within_their_tolerance(name):
    result = CASES[name](quick=True)
    assert result.checks
    assert [check for check in result.checks if not check.passed] == []


@pytest.mark.parametrize("name", ["hanging", "cantilever", "wrenches"])
def test_a_wrong_simulation_misses(name, monkeypatch):
    right = _pbd.Rod

    def five_percent_too_stiff(**parameters):
        return right(**{**parameters, "young_modulus": 1.05 * parameters["young_modulus"]})

    monkeypatch.setattr(_pbd, "Rod", five_percent_too_stiff)
    assert not CASES[name](quick=True).passed


def test_a_wrong_fabric_misses(monkeypatch):
    right = _pbd.Fabric

    def five_percent_too_stiff(**parameters):
        softer = 0.95 * parameters["stretching_compliance"]
        return right(**{**parameters, "stretching_compliance": softer})

    monkeypatch.setattr(_pbd, "Fabric", five_percent_too_stiff)
    assert not CASES["fabrics"](quick=True).passed
