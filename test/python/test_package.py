"""The names that the package itself offers."""

import subprocess
import sys

import pytest

import deformable_manipulation


@pytest.mark.parametrize("name", deformable_manipulation.__all__)
def test_every_offered_name_exists(name):
    assert getattr(deformable_manipulation, name).__name__ == name
    assert name in dir(deformable_manipulation)


def test_other_names_are_no_attributes():
    with pytest.raises(AttributeError, match="no attribute 'nothing_of_this_name'"):
        deformable_manipulation.nothing_of_this_name  # noqa: B018


def test_importing_the_package_loads_none_of_its_parts():
    program = (
        "import sys, deformable_manipulation\n"
        "print(*(name for name in sys.modules if name.startswith('deformable_manipulation.')))"
    )
    loaded = subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.PIPE)
    assert loaded.stdout.strip() == b""
