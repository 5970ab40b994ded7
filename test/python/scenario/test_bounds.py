"""Values that are finite, but of no robot, object or planet."""

import pytest

ROD = [
    ("controller.max_velocity", 1e300, "<= 10 [m/s]"),
    ("controller.max_acceleration", 1e300, "<= 1000 [m/s^2]"),
    ("controller.weights", [1e300] * 3, "<= 1e+06 [1]"),
    ("controller.timeout", 1e300, "<= 1e+06 [s]"),
    ("simulation.gravity", [0, 0, -1e300], ">= -1000 and <= 1000 [m/s^2]"),
    ("object.density", 1e300, "<= 100000 [kg/m^3]"),
    ("object.young_modulus", 1e300, "<= 1e+13 [Pa]"),
    ("object.torsion_modulus", 1e300, "<= 1e+13 [Pa]"),
    ("object.damping", 1e300, "<= 10000 [1/s]"),
    ("object.bending_retardation_time", 1e300, "<= 100 [s]"),
    ("object.drag_coefficient", 1e300, "<= 100"),
]
FABRIC = [
    ("object.density", 1e300, "<= 10000 [kg/m^2]"),
    ("object.thickness", 1e300, "<= 1 [m]"),
    ("object.stretching_compliance", 1e300, "<= 1e+06 [m/N]"),
    ("object.bending_compliance", 1e300, "<= 1e+12 [1/(N m)]"),
]


@pytest.mark.parametrize("key, value, allowed", ROD)
def test_rods(mapping, change, problems_of, key, value, allowed):
    assert allowed in "".join(problems_of(change(mapping, key, value)).values())


@pytest.mark.parametrize("key, value, allowed", FABRIC)
def test_fabrics(fabric_mapping, change, problems_of, key, value, allowed):
    assert allowed in "".join(problems_of(change(fabric_mapping, key, value)).values())
