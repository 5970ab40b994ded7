"""package.xml names the rosdep key of all that scripts/setup installs, where one exists."""

import re
from xml.etree import ElementTree

import pytest

from deformable_manipulation.system.package_files import package_share_directory

CHECKOUT = package_share_directory()

# rosdep has no key for these; the compiler and make come with catkin, the ROS commands with ROS.
WITHOUT_KEY = {
    "g++",
    "make",
    "distributed",
    "daqp",
    "gcovr",
    "mujoco",
    "pytest-xdist",
    "types-PyYAML",
}
OTHER_KEYS = {
    "libdynamic-reconfigure-config-init-mutex-dev": "dynamic_reconfigure",
    "libeigen3-dev": "eigen",
    "libgtest-dev": "gtest",
    "catkin-lint": "python3-catkin-lint",
    "PyYAML": "python3-yaml",
    "python-fcl": "python-fcl-pip",
    "qpsolvers": "python3-qpsolvers-pip",
    "quadprog": "quadprog-pip",
    "rosbags": "python3-rosbags-pip",
    "ruff": "python3-ruff-pip",
    "trimesh": "python3-trimesh-pip",
}


def listed(file):
    lines = (CHECKOUT / "scripts" / file).read_text(encoding="utf-8").splitlines()
    return [re.split("[=>]", line)[0] for line in lines if line and not line.startswith("#")]


def possible_keys(package):
    """A key of its own, the Debian package itself, or the ROS package that Debian has split."""
    ros = re.sub("^(libros-|lib|python3-|ros-)", "", re.sub("-dev$", "", package))
    return {OTHER_KEYS.get(package, package), "python3-" + package, ros.replace("-", "_")}


@pytest.mark.parametrize("file", ["apt-packages.txt", "pip-requirements.txt"])
def test_every_package_has_its_key(file):
    root = ElementTree.parse(str(CHECKOUT / "package.xml")).getroot()
    keys = {element.text for element in root if element.tag.endswith("depend")}
    packages = set(listed(file)) - WITHOUT_KEY
    assert len(packages) > 10
    assert [each for each in sorted(packages) if not possible_keys(each) & keys] == []
