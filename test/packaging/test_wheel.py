"""The wheel in a virtual environment of its own: no ROS, the same results as the checkout."""

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parents[2]
COMMANDS = (
    "benchmark",
    "check_scenario",
    "identify",
    "new_scenario",
    "plot_run",
    "replay",
    "run_campaign",
    "run_scenario",
    "validate",
)
RUN = ["rope_one_assistant", "--set", "simulation.duration=3", "--output"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("wheel")


@pytest.fixture(scope="module")
def programs(folder):
    """The bin/ of the virtual environment that the wheel is installed into."""
    build = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation"]
    subprocess.run([*build, "--wheel-dir", str(folder), str(CHECKOUT)], check=True)
    subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
    (wheel,) = folder.glob("*.whl")
    print("size of the wheel:", wheel.stat().st_size)
    programs = folder / "venv" / "bin"
    subprocess.run([str(programs / "pip"), "install", "--quiet", str(wheel)], check=True)
    return programs


def run(folder, *command):
    """What a command prints, without the environment of this test, which has ROS."""
    kept = ("HOME", "LANG", "PATH")
    return subprocess.run(
        [str(word) for word in command],
        cwd=str(folder),
        env={name: os.environ[name] for name in kept if name in os.environ},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def test_it_has_no_ros(folder, programs):
    done = run(folder, programs / "python3", "-c", "import deformable_manipulation, rospkg")
    assert "No module named 'rospkg'" in done.stdout


@pytest.mark.parametrize("name", COMMANDS)
def test_every_console_command_starts(folder, programs, name):
    done = run(folder, programs / name, "--help")
    assert done.returncode == 0 and f"usage: {name}" in done.stdout


def test_a_run_has_the_results_of_the_checkout(folder, programs):
    done = run(folder, programs / "run_scenario", *RUN, "of_wheel")
    assert done.returncode == 0, done.stdout
    subprocess.run(
        [str(CHECKOUT / "scripts" / "run_scenario"), *RUN, "of_checkout"],
        cwd=str(folder),
        check=True,
    )
    assert measured(folder / "of_wheel") == measured(folder / "of_checkout")


def measured(run_folder):
    """The time series, but how long the solver took."""
    with open(run_folder / "timeseries.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 300
    return [{key: row[key] for key in row if not key.endswith("solve_time")} for row in rows]


def test_a_new_scenario_is_made_run_and_plotted(folder, programs):
    for command in (
        ["new_scenario", "my_rope"],
        ["check_scenario", "my_rope.yaml"],
        ["run_scenario", "my_rope.yaml", "--set", "simulation.duration=1", "--output", "my_run"],
        ["plot_run", "my_run"],
    ):
        done = run(folder, programs / command[0], *command[1:])
        assert done.returncode == 0, done.stdout
    assert (folder / "my_run" / "overview.png").is_file()


def test_a_library_of_an_extra_is_named_where_it_is_missing(folder, programs):
    solver = ["--set", "controller.solver=quadprog", "--output", "no_run"]
    done = run(folder, programs / "run_scenario", *RUN[:-1], *solver)
    assert done.returncode == 1
    assert done.stdout.splitlines()[-1].startswith("run_scenario: the Python module 'qpsolvers'")
