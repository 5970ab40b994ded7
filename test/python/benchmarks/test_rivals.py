"""Other libraries: there, not there, broken."""

import json
import os
import stat
import sys

import pytest

from deformable_manipulation.benchmarks.fabric_comparison import contest
from deformable_manipulation.benchmarks.harness import QUICK
from deformable_manipulation.benchmarks.rivals import environment
from deformable_manipulation.benchmarks.rivals.catalogue import FABRIC_RIVALS, ROD_RIVALS, Rival
from deformable_manipulation.benchmarks.rivals.environment import (
    InstallationError,
    default_environment,
    install,
    interpreter,
)
from deformable_manipulation.benchmarks.rivals.subprocess_trial import NOT_INSTALLED, run_in
from deformable_manipulation.benchmarks.rod_case import CANTILEVER, ROPE
from deformable_manipulation.benchmarks.rod_comparison import make_case
from deformable_manipulation.benchmarks.rod_theory import error_of

CASE = make_case(ROPE, 28)


@pytest.fixture
def make_environment(tmp_path):
    """An environment whose interpreter is a script."""

    def make(script):
        python = interpreter(tmp_path)
        python.parent.mkdir()
        python.write_text(f"#!{sys.executable}\n{script}\n")
        python.chmod(python.stat().st_mode | stat.S_IXUSR)
        return tmp_path

    return make


@pytest.fixture
def own_environment(make_environment):
    """The interpreter of the tests, in the place of the other libraries' one."""
    return make_environment(
        "import os, sys; os.execv(sys.executable, [sys.executable] + sys.argv[1:])"
    )


@pytest.mark.parametrize("rival", [*ROD_RIVALS, *FABRIC_RIVALS], ids=str)
def test_without_the_environment_nothing_is_installed(rival, tmp_path):
    outcome = run_in(tmp_path / "nowhere", rival, CASE, QUICK)
    assert outcome.trial is None
    assert outcome.problem == NOT_INSTALLED and "--install-rivals" in outcome.problem


def test_an_environment_without_the_library_says_so(own_environment):
    rival = Rival("nobody's", "no-distribution-has-this-name", "pypbd_rod")
    outcome = run_in(own_environment, rival, CASE, QUICK)
    assert outcome.trial is None
    assert outcome.problem.startswith(NOT_INSTALLED)
    assert "no-distribution-has-this-name" in outcome.problem


def test_a_library_that_does_not_load_says_so(own_environment):
    rival = Rival("no adapter", "numpy", "no_adapter_of_this_name")
    outcome = run_in(own_environment, rival, CASE, QUICK)
    assert outcome.trial is None and "no_adapter_of_this_name" in outcome.problem


def test_a_crash_is_reported_with_its_last_words(make_environment):
    script = "import sys; print('some trace', file=sys.stderr); sys.exit('out of rope')"
    outcome = run_in(make_environment(script), ROD_RIVALS[0], CASE, QUICK)
    assert outcome.trial is None
    assert "status 1" in outcome.problem and "out of rope" in outcome.problem


def test_the_job_reaches_the_library_and_its_result_comes_back(make_environment):
    # The interpreter answers with what it was asked, in place of the sentence on the settings.
    script = (
        "import json, os, sys\n"
        "job = json.load(sys.stdin)\n"
        "job['threads'] = os.environ['OMP_NUM_THREADS']\n"
        "trial = dict(points=[[0, 0]], time_step=0.1, settings=json.dumps(job),\n"
        "             settling_time=None)\n"
        "print('chatter')\n"
        "json.dump({'version': '7', 'trial': trial}, open(sys.argv[-1], 'w'))"
    )
    outcome = run_in(make_environment(script), ROD_RIVALS[1], CASE, QUICK)
    assert (outcome.version, outcome.problem) == ("7", "")
    job = json.loads(outcome.trial.settings)
    assert job["rival"]["options"] == ROD_RIVALS[1].options
    assert job["kind"] == "RodCase"
    assert (job["case"]["segments"], job["case"]["young_modulus"]) == (28, 3.0e7)
    assert job["effort"]["repetitions"] == QUICK.repetitions
    assert job["threads"] == "1"


# Makes an environment whose pip fails; called as python -m venv --clear FOLDER.
_VENV_WITHOUT_INDEX = """import pathlib, sys
python = pathlib.Path(sys.argv[-1], "bin", "python3")
python.parent.mkdir(parents=True)
python.write_text("#!/bin/sh\\nexit 5\\n")
python.chmod(0o755)"""


def test_a_failed_installation_leaves_nothing_behind(make_environment, tmp_path, monkeypatch):
    monkeypatch.setattr(environment, "checkout", lambda: tmp_path)
    with pytest.raises(InstallationError, match="pip-requirements-rivals.txt"):
        install(tmp_path / "env")
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts" / "pip-requirements-rivals.txt").write_text("")
    python = interpreter(make_environment(_VENV_WITHOUT_INDEX))
    monkeypatch.setattr(environment.sys, "executable", str(python))
    with pytest.raises(InstallationError, match="install --requirement .* status 5"):
        install(tmp_path / "env")
    assert not (tmp_path / "env").exists()


with_libraries = pytest.mark.skipif(
    not interpreter(default_environment()).is_file(),
    reason="the other libraries are not installed: scripts/benchmark --install-rivals",
)


@with_libraries
@pytest.mark.parametrize("load", [ROPE, CANTILEVER])
@pytest.mark.parametrize(
    "rival", [rival for rival in ROD_RIVALS if rival.name != "PyElastica"], ids=str
)
def test_the_other_libraries_come_near_theory(rival, load):
    # PyElastica takes millions of steps.
    case = make_case(load, 28)
    outcome = run_in(default_environment(), rival, case, QUICK)
    assert not outcome.problem and outcome.trial.settling_time < 10.0
    assert abs(error_of(outcome.trial, case)) < 3e-3
    assert not os.path.exists("MUJOCO_LOG.TXT")


@with_libraries
@pytest.mark.parametrize("rival", FABRIC_RIVALS, ids=str)
def test_the_other_libraries_hang_a_cloth_near_the_equilibrium_of_its_mesh(rival):
    cloth = contest(8)
    outcome = run_in(default_environment(), rival, cloth.case, QUICK)
    assert not outcome.problem and outcome.trial.settling_time < 10.0
    assert cloth.error_of(outcome.trial, cloth.case) < 0.03
