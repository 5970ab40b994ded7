"""What every kind of obstacle has."""

import math
from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Any, ClassVar, Dict, Iterator, List, Optional, Sequence, Tuple, TypeVar, cast

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.obstacles.drawings import Drawing
from deformable_manipulation.obstacles.motions import MOTION, Motion
from deformable_manipulation.reading.names import ONE_LINE
from deformable_manipulation.reading.parameter import declared, parameter
from deformable_manipulation.reading.plain import plain
from deformable_manipulation.reading.readers import Flag, UnitQuaternion, position

_UNIT_TOLERANCE = 1e-6
_Spec = TypeVar("_Spec", bound="ObstacleSpec")

# Keys that every kind has. They stand in each class, in the order of its arguments.
NAME = parameter(ONE_LINE, "Appears in messages and markers.")
TRANSLATION = parameter(position(), "Moves the obstacle.", default=(0.0, 0.0, 0.0))
ROTATION = parameter(
    UnitQuaternion(),
    "Turns it about its origin, before `translation`.",
    default=(0.0, 0.0, 0.0, 1.0),
)
MOTION_OF_OBSTACLE = parameter(
    MOTION,
    "What moves it, see [below](#obstacles-motion).",
    default=None,
    default_text="none: it stands still",
)

KNOWN = parameter(
    Flag(),
    "Whether the controllers know it. `false`: it is really there, and the recorded distances are "
    "from it, but the controllers learn of it from what a [camera](#camera) sees, if at all.",
    default=True,
)

REAL = parameter(
    Flag(),
    "Whether it is really there. `false`: it is a map of other obstacles. The controllers keep "
    "off it, but the recorded distances are not from it, and a camera does not see it.",
    default=True,
    allowed="`false` only where it is known",
)


class ObstacleSpec(ABC):
    """An obstacle of any kind, as checked data.

    A point p of its own frame lies at ``translation + rotation * p`` in the fixed frame.

    Attributes:
        kind: the key that says its kind in the scenario.
        plane: the plane that it is given in, such as ``yz``; None: it is given in space.
        is_around_origin: whether its origin is where it is.
        is_live: whether what there is of it comes while the run goes on; nothing is there before.
    """

    kind: ClassVar[str]
    plane: Optional[str] = None
    is_around_origin: ClassVar[bool] = False
    is_live: ClassVar[bool] = False
    name: str
    translation: Vector
    rotation: Quaternion
    motion: Optional[Motion]
    known: bool
    real: bool

    @property
    def endless(self) -> str:
        """How it goes on beyond its corners, in words; empty: it does not."""
        return ""

    @abstractmethod
    def native(self) -> Tuple[Any, List[str]]:
        """The C++ core's obstacle in its own frame, and warnings.

        Raises:
            ValueError: its shape is invalid, with all reasons.
        """

    @abstractmethod
    def corners(self) -> np.ndarray:
        """Points (N, 3) [m] of its own frame that it reaches to.

        Raises:
            ValueError: its file cannot be read.
        """

    @abstractmethod
    def drawing(self) -> Drawing:
        """What is drawn of it, in its own frame.

        Raises:
            ValueError: its file cannot be read.
        """

    @abstractmethod
    def description(self) -> str:
        """What kind of obstacle it is, in a few words."""

    def problems(self) -> Iterator[str]:
        """What is wrong with its numbers, if they have not been read from a scenario."""
        if not are_numbers(self.translation, 3):
            yield "translation is {}; it must be three finite numbers of metres".format(
                self.translation
            )
        length = math.sqrt(sum(q * q for q in self.rotation))
        if not are_numbers(self.rotation, 4) or abs(length - 1.0) > _UNIT_TOLERANCE:
            yield "rotation is {}; it must be a quaternion x, y, z, w of length 1".format(
                self.rotation
            )

    def at(self: _Spec, translation: Vector, rotation: Quaternion) -> _Spec:
        """The same obstacle elsewhere."""
        return replace(cast(Any, self), translation=translation, rotation=rotation)

    def to_mapping(self) -> Dict[str, Any]:
        """An item of the section ``obstacles`` as plain values."""
        values = plain(self)
        mapping = {key: values[attribute] for key, (attribute, _) in declared(self).items()}
        if self.motion is None:
            mapping.pop("motion", None)
        for key in ("known", "real"):
            if getattr(self, key):
                mapping.pop(key, None)
        return mapping


def are_numbers(values: Sequence[Any], count: int) -> bool:
    """Whether there are so many finite numbers."""
    return len(values) == count and all(
        isinstance(value, (int, float, np.number)) and math.isfinite(value) for value in values
    )


def are_as_known(obstacles: Sequence[ObstacleSpec]) -> bool:
    """Whether the controllers know all that is there, and nothing else."""
    return all(each.known and each.real for each in obstacles)


def placed(obstacle: ObstacleSpec, points: np.ndarray) -> np.ndarray:
    """Points (..., 3) [m] of an obstacle's own frame in the fixed frame."""
    columns = np.array([rotate(obstacle.rotation, tuple(axis)) for axis in np.eye(3)])
    return points @ columns + np.array(obstacle.translation)


def obstacle_corners(obstacle: ObstacleSpec) -> np.ndarray:
    """:meth:`ObstacleSpec.corners` in the fixed frame."""
    return placed(obstacle, obstacle.corners())
