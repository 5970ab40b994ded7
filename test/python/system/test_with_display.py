"""scripts/with_display."""

import os
import subprocess

import pytest

from deformable_manipulation.scenario import package_share_directory

SCRIPT = package_share_directory() / "scripts" / "with_display"


@pytest.mark.parametrize("display", [None, "", ":65000"])
def test_without_a_display_it_says_so_instead_of_the_command(display):
    environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
    if display is not None:
        environment["DISPLAY"] = display

    def run(*arguments):
        return subprocess.run(
            [str(SCRIPT), *arguments],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )

    done = run("echo", "shown")
    assert (done.returncode, done.stdout) == (0, "")
    (line,) = done.stderr.splitlines()
    assert line.startswith("no display") and line.endswith("use rviz:=false")
    checked = run("--check")
    assert (checked.returncode, checked.stdout, checked.stderr) == (1, "", "")
