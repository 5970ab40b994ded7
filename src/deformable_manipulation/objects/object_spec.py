"""What every kind of object tells about itself."""

from abc import ABC, abstractmethod
from typing import Any, Callable, ClassVar, Dict, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Pose, Vector
from deformable_manipulation.reading.plain import to_plain
from deformable_manipulation.reading.readers import Node, Number, Section, UnitQuaternion, position

# Ropes and rods yield less than a thousandth to any load in use; what is longer has been pulled
# apart, and its shape and distances mean nothing.
LARGEST_VALID_STRETCH = 0.01

# Keys of the section that all kinds have.
DAMPING = Number("1/s", at_least=0.0, at_most=1e4)
POSE = Section(Pose, {"position": position(), "orientation": UnitQuaternion()})


class ObjectSpec(ABC):
    """A deformable object as plain immutable data.

    A kind of object is a frozen dataclass that extends this one, in a module of its own, and a
    line in :mod:`~deformable_manipulation.objects.kinds`.
    """

    type: ClassVar[str]  # the word in the scenario
    is_surface: ClassVar[bool]  # of triangles; else a line of segments
    has_joint_solver: ClassVar[bool]  # simulation.solver chooses it
    default_jacobian: ClassVar[str]  # controller.jacobian where it is not given
    rviz_example: ClassVar[str]  # the scenario whose RViz configuration shows this kind

    pose: Pose
    triangles: Optional[Tuple[Tuple[int, int, int], ...]]  # of its points; None: of a line

    @classmethod
    @abstractmethod
    def read(cls, node: Node) -> "ObjectSpec":
        """Read and check the ``object`` section, after its material has been filled in."""

    def to_mapping(self) -> Dict[str, Any]:
        """The ``object`` section as plain values, from which an equal object is read."""
        return {"type": self.type, **to_plain(self)}

    @property
    @abstractmethod
    def particles(self) -> int:
        """Number of particles that can be held."""

    @property
    @abstractmethod
    def margin(self) -> float:
        """Distance [m] of the surface from the simulated points."""

    @abstractmethod
    def particle_position(self, particle: int) -> Vector:
        """Position [m] of a particle on the undeformed object, in the fixed frame."""

    @abstractmethod
    def free_length(self, first: int, second: int) -> float:
        """Greatest distance [m] between two particles that does not stretch the object."""

    @abstractmethod
    def edges(self) -> Tuple[np.ndarray, np.ndarray]:
        """The edges between points: indices of their ends (E, 2), undeformed lengths (E,) [m]."""

    @abstractmethod
    def valid_stretch(self, gravity: Vector) -> float:
        """The largest relative change of length [1] of an edge that an object in use has.

        Args:
            gravity: m/s^2.
        """

    @abstractmethod
    def auto_substeps(self, time_step: float) -> int:
        """Substeps per time step [s] that suit the object: ``simulation.substeps: auto``."""

    @abstractmethod
    def make_body(self, gravity: Vector, solver: str):
        """The C++ body, undeformed and held nowhere: a ``_pbd.Body``.

        Args:
            gravity: m/s^2.
            solver: of the joints, where the kind has any.

        Raises:
            _pbd.ParameterError: a parameter is out of range.
        """

    @abstractmethod
    def scaled_material(self, stiffness: float, density: float) -> "ObjectSpec":
        """The same object, as many times as stiff and as dense."""

    @abstractmethod
    def varied_material(self, draw: Callable[[], float]) -> "ObjectSpec":
        """The same object of another material; ``draw`` gives a factor at each call."""

    @abstractmethod
    def describe(self) -> str:
        """What is carried, in a few words."""

    @abstractmethod
    def describe_material(self) -> str:
        """What it is made of: the values that a material preset and the scenario give."""
