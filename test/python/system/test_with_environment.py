"""scripts/with_environment in a checkout that is built, partly built or not built."""

import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[3] / "scripts" / "with_environment"
PACKAGE = "deformable_manipulation"


@pytest.fixture
def checkout(tmp_path):
    (tmp_path / "scripts").mkdir()
    shutil.copy(str(SCRIPT), str(tmp_path / "scripts"))
    return tmp_path


@pytest.fixture
def built(checkout):
    """A checkout as after a complete build."""
    space = checkout / "build" / "devel"
    configuration = space / "share" / PACKAGE / "cmake" / (PACKAGE + "Config.cmake")
    configuration.parent.mkdir(parents=True)
    configuration.write_text(f"set({PACKAGE}_SOURCE_PREFIX {checkout})\n")
    (space / "setup.bash").write_text("export SOURCED=here\n")
    modules = space / "lib" / "python3" / "dist-packages" / PACKAGE
    for name in ("_control.so", "_distance.so", "_pbd.so", "msg/__init__.py", "srv/__init__.py"):
        (modules / name).parent.mkdir(parents=True, exist_ok=True)
        (modules / name).touch()
    return checkout


def run(checkout):
    script = checkout / "scripts" / "with_environment"
    return subprocess.run(
        [str(script), "sh", "-c", "echo $SOURCED $1", "-", "a b"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
    )


def test_a_command_runs_in_the_environment_of_the_build(built):
    done = run(built)
    assert (done.returncode, done.stdout, done.stderr) == (0, "here a b\n", "")


def test_without_a_build_it_says_what_to_do(checkout):
    done = run(checkout)
    assert done.returncode == 1 and done.stdout == ""
    assert "not built: run scripts/setup" in done.stderr


@pytest.mark.parametrize("part", ["_pbd.so", "_control.so", "msg/__init__.py"])
def test_a_build_that_is_not_complete_is_named_before_python_fails(built, part):
    (built / "build" / "devel" / "lib" / "python3" / "dist-packages" / PACKAGE / part).unlink()
    done = run(built)
    assert done.returncode == 1 and done.stdout == ""
    assert part.replace(".so", "") in done.stderr and "run scripts/setup" in done.stderr
