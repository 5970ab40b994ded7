"""What setup.py takes from scripts/pip-requirements.txt for the wheel."""

import runpy
from unittest import mock

from deformable_manipulation.system.package_files import package_share_directory

SETUP = package_share_directory() / "setup.py"


def read():
    """setup.py's names, and what it gives to setup(), read as catkin reads it."""
    with mock.patch("setuptools.setup") as setup:
        names = runpy.run_path(str(SETUP))
    return names, setup.call_args.kwargs


def test_catkin_gets_only_what_it_knows():
    given = read()[1]
    assert given["name"] == "deformable_manipulation"
    assert not {"ext_modules", "entry_points", "install_requires"} & set(given)


def test_requirements_are_those_of_the_files_by_extra_and_python():
    requirements = read()[0]["requirements"]()
    assert 'numpy==1.26.4; python_version >= "3.11"' in requirements[""]
    assert 'numpy==1.24.4; python_version < "3.11"' in requirements[""]
    assert {"", "cluster", "reference", "benchmarks", "mujoco", "tests"} == set(requirements)
    assert not any(text.startswith(("quadprog", "pytest")) for text in requirements[""])


def test_the_files_of_the_package_go_to_its_share_directory():
    files = dict(read()[0]["data_files"]())
    share = "share/deformable_manipulation"
    assert files[share] == ["package.xml"]
    assert "config/scenarios/rope_one_assistant.yaml" in files[share + "/config/scenarios"]
    assert "config/obstacles/cube.obj" in files[share + "/config/obstacles"]
