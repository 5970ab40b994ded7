"""Runs the package's commands and reads the numbers that they write."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable, Dict, List, Sequence

from deformable_manipulation.campaign.exit_status import UNACCEPTABLE

Say = Callable[[str], None]


class MeasurementError(RuntimeError):
    """A command failed; the end of what it printed is in the text."""


def run_scenario(name: str, options: Sequence[str], say: Say) -> Dict:
    """Run a scenario without ROS; returns its ``summary.json``.

    Raises:
        MeasurementError: it failed.
    """
    return _run(["run_scenario", name, *options], (0,), "summary.json", say)


def run_campaign(name: str, options: Sequence[str], say: Say) -> Dict:
    """Run a campaign; returns the ``summary`` of its ``campaign.json``.

    Raises:
        MeasurementError: it failed. Missed limits are no failure.
    """
    return _campaign(name, options, say)["summary"]


def run_classes(name: str, options: Sequence[str], say: Say) -> List[Dict]:
    """Run a campaign; returns the ``classes`` of its ``campaign.json``.

    Raises:
        MeasurementError: as for :func:`run_campaign`.
    """
    return _campaign(name, options, say)["classes"]


def _campaign(name: str, options: Sequence[str], say: Say) -> Dict:
    return _run(["run_campaign", name, *options], (0, UNACCEPTABLE), "campaign.json", say)


def _run(arguments: Sequence[str], accepted: Sequence[int], result: str, say: Say) -> Dict:
    say(" ".join(arguments))
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "run"
        command = [sys.executable, "-m", "deformable_manipulation.commands", *arguments]
        ran = subprocess.run(
            [*command, "--output", str(output)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            universal_newlines=True,
        )
        if ran.returncode not in accepted:
            last = "\n".join(ran.stdout.strip().splitlines()[-5:])
            raise MeasurementError(
                f"{' '.join(arguments)} ended with exit status {ran.returncode}:\n{last}"
            )
        return json.loads((output / result).read_text(encoding="utf-8"))
