"""This package in a catkin workspace: built and installed by catkin_make, and run from there.

The environment variable CATKIN_WORKSPACE names the folder of the workspace, which is kept.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parents[2]
PACKAGE = "deformable_manipulation"
SHORT = "simulation.duration=3"


@pytest.fixture(scope="module")
def workspace():
    folder = Path(os.environ["CATKIN_WORKSPACE"])
    (folder / "src").mkdir(parents=True, exist_ok=True)
    link = folder / "src" / PACKAGE
    if not link.exists():
        link.symlink_to(CHECKOUT)
    command = ["catkin_make", "install", "-DPYTHON_EXECUTABLE=" + sys.executable]
    subprocess.run(command, cwd=str(folder), env=clean_environment(), check=True)
    return folder


def clean_environment():
    """Without this test's own environment, which has the checkout's build in it."""
    kept = ("HOME", "LANG", "ROS_MASTER_URI")
    environment = {name: os.environ[name] for name in kept if name in os.environ}
    return {**environment, "PATH": "/usr/local/bin:/usr/bin:/bin"}


def run(workspace, folder, command):
    """Run in a shell that has sourced the install space; returns what was printed."""
    shell = "source {}/install/setup.bash && {}".format(workspace, command)
    done = subprocess.run(
        ["bash", "-c", shell],
        cwd=str(folder),
        env=clean_environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def test_modules_and_files_are_those_installed(workspace, tmp_path):
    program = (
        "import deformable_manipulation._pbd as module;"
        "from deformable_manipulation.scenario import package_share_directory;"
        "print(module.__file__, package_share_directory())"
    )
    printed = run(workspace, tmp_path, 'python3 -c "{}"'.format(program))
    assert all(Path(path).is_relative_to(workspace / "install") for path in printed.split())


def test_a_command_by_rosrun(workspace, tmp_path):
    command = "rosrun deformable_manipulation run_scenario rope_one_assistant --output run --set "
    run(workspace, tmp_path, command + SHORT)
    assert (tmp_path / "run" / "timeseries.csv").is_file()


def test_a_run_by_roslaunch(workspace, tmp_path):
    arguments = (
        "rviz:=false lockstep:=true stop_at_end:=true record:=true output:=$PWD set:=" + SHORT
    )
    command = "roslaunch -p 11399 deformable_manipulation rope_one_assistant.launch " + arguments
    printed = run(workspace, tmp_path, "ROS_MASTER_URI=http://localhost:11399 " + command)
    assert "finished cleanly" in printed
    assert list(tmp_path.glob("*.bag"))
