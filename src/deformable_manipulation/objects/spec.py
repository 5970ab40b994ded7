"""What every kind of object has."""

from abc import ABC, abstractmethod
from typing import Any, Callable, ClassVar, Dict, Iterator, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.reading.plain import plain


class ObjectSpec(ABC):
    """An object of any kind, as checked data.

    Attributes:
        type: the word that says its kind in the scenario, and in the C++ core.
        jacobian: where its gradients come from, unless the scenario says so.
        disturbance_filter: time constant [s] of the disturbance observer, likewise.
        horizon_length: how far [s] its controllers look ahead, likewise.
        collision_margin, collision_speed_margin, collision_snap_margin: what is kept beyond the
            offset [m], per speed of the leader [s], and at most where copies part [m], likewise.
        has_joints: whether it has joints, which ``simulation.solver`` is for.
        is_surface: whether it is made of triangles, and else a line of its points.
        rviz_example: the scenario whose RViz configuration shows this kind.
    """

    type: ClassVar[str]
    jacobian: ClassVar[str]
    disturbance_filter: ClassVar[float]
    horizon_length: ClassVar[float]
    collision_margin: ClassVar[float]
    collision_speed_margin: ClassVar[float]
    collision_snap_margin: ClassVar[float]
    has_joints: ClassVar[bool]
    is_surface: ClassVar[bool]
    rviz_example: ClassVar[str]

    def warnings(self) -> Iterator[str]:
        """What was mended when it was read, and values of its material that are rarely meant."""
        return iter(())

    @property
    @abstractmethod
    def particles(self) -> int:
        """Number of particles that can be held."""

    @property
    @abstractmethod
    def margin(self) -> float:
        """Distance [m] of the surface from the geometry points."""

    @abstractmethod
    def faces(self) -> Optional[np.ndarray]:
        """(T, 3) points of its triangles; None of a line."""

    @abstractmethod
    def edges(self) -> Tuple[np.ndarray, np.ndarray]:
        """Points at the ends (E, 2) and undeformed lengths (E,) [m] of all edges."""

    @abstractmethod
    def particle_position(self, particle: int) -> Vector:
        """Position [m] of a particle on the undeformed object, in the fixed frame."""

    @abstractmethod
    def particle_orientation(self, particle: int) -> Quaternion:
        """Orientation of a particle on the undeformed object, in the fixed frame."""

    @abstractmethod
    def free_length(self, first: int, second: int) -> float:
        """Greatest distance [m] between two particles that does not stretch the object."""

    def held_by(self, grips: Sequence[Tuple[int, Optional[float]]]) -> "ObjectSpec":
        """The same object as agents hold it.

        Args:
            grips: for each agent its particle, and the length [m] of the object that it keeps
                straight, if it has one of its own.
        """
        return self

    @abstractmethod
    def substeps(self, time_step: float) -> int:
        """Substeps per time step [s] that suit it: ``simulation.substeps: auto``."""

    @abstractmethod
    def valid_stretch(self, gravity: Vector) -> float:
        """The largest relative change of length [1] that such an object in use has."""

    @abstractmethod
    def with_factors(self, stiffness: float, density: float) -> "ObjectSpec":
        """The same object with its stiffnesses and its density times a factor."""

    @abstractmethod
    def with_random_material(self, draw: Callable[[], float]) -> "ObjectSpec":
        """The same object of another material; each call of ``draw`` gives a factor."""

    @abstractmethod
    def description(self) -> str:
        """What it is, in a few words."""

    @abstractmethod
    def material_description(self) -> str:
        """What it is made of."""

    def to_mapping(self) -> Dict[str, Any]:
        """The section ``object`` as plain values."""
        return {"type": self.type, **plain(self)}
