"""The libraries that are compared with."""

from dataclasses import dataclass, field
from typing import Dict, Sequence


@dataclass(frozen=True)
class Rival:
    """A library, and one way to use it."""

    name: str
    distribution: str  # on PyPI
    module: str  # of this package: has make(case, **options)
    options: Dict[str, int] = field(default_factory=dict)


RIVALS: Sequence[Rival] = (
    Rival("pyPBD", "pyPBD", "pypbd_rod", {"iterations": 1}),
    Rival("pyPBD", "pyPBD", "pypbd_rod", {"iterations": 5}),
    Rival("MuJoCo", "mujoco", "mujoco_rod"),
    Rival("PyElastica", "pyelastica", "pyelastica_rod"),
)
