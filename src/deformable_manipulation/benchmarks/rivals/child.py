"""Runs in the interpreter of the other libraries: a job on standard input, its result in a file."""

import importlib
import json
import sys
from dataclasses import asdict
from importlib import metadata
from pathlib import Path

from deformable_manipulation.benchmarks.fabric_case import FabricCase
from deformable_manipulation.benchmarks.harness import Effort
from deformable_manipulation.benchmarks.rivals.subprocess_trial import NOT_INSTALLED
from deformable_manipulation.benchmarks.rod_case import RodCase
from deformable_manipulation.benchmarks.trial import TrialError, run_trial

CASES = {kind.__name__: kind for kind in (RodCase, FabricCase)}


def main() -> int:
    """Read the job, write the result; returns the exit status."""
    job = json.load(sys.stdin)
    Path(sys.argv[1]).write_text(json.dumps(_answer(job)), encoding="utf-8")
    return 0


def _answer(job: dict) -> dict:
    rival, case = job["rival"], CASES[job["kind"]](**job["case"])
    try:
        version = metadata.version(rival["distribution"])
        adapter = importlib.import_module(f"{__package__}.{rival['module']}")
    except ImportError as error:
        return {"problem": f"{NOT_INSTALLED} ({error})"}
    try:
        model = adapter.make(case, **rival["options"])
        trial = run_trial(model, case, Effort(**job["effort"]))
    except TrialError as error:
        return {"version": version, "problem": f"failed: {error}"}
    return {"version": version, "trial": asdict(trial)}


if __name__ == "__main__":
    sys.exit(main())
