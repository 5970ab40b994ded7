"""A trial in the interpreter of the other libraries."""

import json
import os
import subprocess
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Optional

from deformable_manipulation.benchmarks.harness import Effort
from deformable_manipulation.benchmarks.rivals.catalogue import Rival
from deformable_manipulation.benchmarks.rivals.environment import INSTALL, interpreter
from deformable_manipulation.benchmarks.trial import Case, Trial

SOURCES = Path(__file__).resolve().parents[3]  # the folder that holds this package
CHILD = "deformable_manipulation.benchmarks.rivals.child"
NOT_INSTALLED = f"not installed: {INSTALL}"
TIME_LIMIT = 90.0  # s
ONE_THREAD = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMBA_NUM_THREADS",
)


@dataclass(frozen=True)
class Outcome:
    """A trial and the library's version, or why there is none."""

    trial: Optional[Trial]
    version: str
    problem: str = ""


def run_in(environment: Path, rival: Rival, case: Case, effort: Effort) -> Outcome:
    """Run the trial of a library, in one thread."""
    python = interpreter(environment)
    if not python.is_file():
        return Outcome(None, "", NOT_INSTALLED)
    job = {
        "rival": asdict(rival),
        "kind": type(case).__name__,
        "case": asdict(case),  # type: ignore[call-overload]  # each is a dataclass
        "effort": asdict(effort),
    }
    # A folder of its own: libraries leave logs where they are started.
    with tempfile.TemporaryDirectory(prefix="benchmark_") as folder:
        result = Path(folder) / "result.json"
        command = [str(python), "-m", CHILD, str(result)]
        try:
            done = subprocess.run(
                command,
                input=json.dumps(job),
                cwd=folder,
                env=_environment(),
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                universal_newlines=True,
                timeout=TIME_LIMIT,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return Outcome(None, "", f"failed: no result within {TIME_LIMIT:g} s")
        if done.returncode != 0:
            reason = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
            return Outcome(None, "", f"failed (status {done.returncode}): {reason}")
        return _outcome(json.loads(result.read_text(encoding="utf-8")))


def _outcome(answer: dict) -> Outcome:
    if "trial" not in answer:
        return Outcome(None, answer.get("version", ""), answer["problem"])
    return Outcome(Trial(**answer["trial"]), answer["version"])


def _environment() -> dict:
    # The libraries' own packages, not those that ROS or this package's environment put on the path.
    environment = dict(os.environ, PYTHONPATH=str(SOURCES))
    environment.pop("PYTHONHOME", None)
    environment.update({name: "1" for name in ONE_THREAD})
    return environment
