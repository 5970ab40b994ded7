"""What can be measured: each subject is a module of its own, loaded when it is asked for."""

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Callable, Dict, List

from deformable_manipulation.benchmarks.harness import FULL, QUICK, Effort
from deformable_manipulation.benchmarks.table import Table


@dataclass(frozen=True)
class Request:
    """How a subject is to be measured."""

    quick: bool
    rivals: Path  # environment of the other libraries; need not be there
    say: Callable[[str], None]  # told what is measured next

    @property
    def effort(self) -> Effort:
        return QUICK if self.quick else FULL


@dataclass(frozen=True)
class Subject:
    """One subject; its module has ``measure_tables(request) -> List[Table]``."""

    summary: str
    module: str
    libraries: tuple = ()  # Python packages whose versions matter

    def measure(self, request: Request) -> List[Table]:
        """Make all tables."""
        return import_module(self.module).measure_tables(request)


SUBJECTS: Dict[str, Subject] = {
    "rod": Subject(
        "a substep of a rod and its copies; the same rods in other libraries, with their errors",
        "deformable_manipulation.benchmarks.rod",
        ("numpy",),
    ),
    "qp": Subject(
        "the safety filter's quadratic program",
        "deformable_manipulation.benchmarks.qp",
        ("numpy", "quadprog", "qpsolvers", "daqp"),
    ),
    "cycle": Subject(
        "the parts of a controller cycle, in one process without ROS",
        "deformable_manipulation.benchmarks.cycle",
        ("numpy",),
    ),
    "loop": Subject(
        "the nodes in real time: from a state to its commands, processor time and memory",
        "deformable_manipulation.benchmarks.loop",
    ),
    "distance": Subject(
        "minimum distances to polygons and meshes, beside Shapely, FCL and Trimesh",
        "deformable_manipulation.benchmarks.distance",
        ("numpy", "shapely", "python-fcl", "trimesh"),
    ),
}
