"""The libraries that are compared with."""

from dataclasses import dataclass, field
from typing import Any, Dict, Sequence


@dataclass(frozen=True)
class Rival:
    """A library, and one way to use it."""

    name: str
    distribution: str  # on PyPI
    module: str  # of this package: has make(case, **options)
    options: Dict[str, Any] = field(default_factory=dict)


ROD_RIVALS: Sequence[Rival] = (
    Rival("pyPBD", "pyPBD", "pypbd_rod", {"iterations": 1}),
    Rival("pyPBD", "pyPBD", "pypbd_rod", {"iterations": 5}),
    Rival("MuJoCo", "mujoco", "mujoco_rod"),
    Rival("PyElastica", "pyelastica", "pyelastica_rod"),
)

FABRIC_RIVALS: Sequence[Rival] = (
    Rival("pyPBD", "pyPBD", "pypbd_fabric", {"iterations": 1, "step_us": 1000}),
    Rival("pyPBD", "pyPBD", "pypbd_fabric", {"iterations": 1, "step_us": 300}),
    Rival("pyPBD", "pyPBD", "pypbd_fabric", {"iterations": 20, "step_us": 5000}),
    Rival("MuJoCo", "mujoco", "mujoco_fabric", {"integrator": "Euler", "step_us": 500}),
    Rival("MuJoCo", "mujoco", "mujoco_fabric", {"integrator": "discrete", "step_us": 5000}),
)
