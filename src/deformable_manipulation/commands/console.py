"""The console commands of an installation without ROS."""

import os
import sys
from pathlib import Path

from deformable_manipulation.commands.guard import run_command

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main() -> int:
    """Run the command whose name this program has; returns its exit status."""
    name = Path(sys.argv[0]).stem
    if name == "benchmark":
        # One thread: libraries below numpy start one per core when they are loaded.
        os.environ.update(dict.fromkeys(THREADS, "1"))
    return run_command(name, sys.argv[1:])
