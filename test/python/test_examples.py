"""The scripts of examples/, each as a user runs it."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SCRIPTS = sorted(path.name for path in EXAMPLES.glob("*.py") if path.name != "output_folder.py")
PNG = b"\x89PNG\r\n\x1a\n"


@pytest.mark.parametrize("script", SCRIPTS)
def test_example_runs_and_draws_what_it_should(script, tmp_path):
    text = (EXAMPLES / script).read_text(encoding="utf-8")
    draws = "output_folder" in text
    command = [sys.executable, str(EXAMPLES / script)] + (["pictures"] if draws else [])
    done = subprocess.run(
        command, cwd=str(tmp_path), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )

    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()
    assert not done.stderr
    for name in re.findall(r'folder / "(.+\.png)"', text):
        assert (tmp_path / "pictures" / name).read_bytes().startswith(PNG)
    assert [path.name for path in tmp_path.iterdir()] == (["pictures"] if draws else [])


def test_readme_lists_all_examples():
    readme = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    assert sorted(set(re.findall(r"\]\((\w+\.py)\)", readme))) == SCRIPTS


def test_a_folder_of_its_own_where_none_is_named(tmp_path):
    done = subprocess.run(
        [sys.executable, str(EXAMPLES / "fit_stiffness.py")],
        env=dict(os.environ, TMPDIR=str(tmp_path)),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    (folder,) = tmp_path.iterdir()
    assert str(folder) in done.stdout
    assert (folder / "fit_stiffness.png").exists()
