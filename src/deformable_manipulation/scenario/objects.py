"""The ``object`` section: one reader and one geometry per type of object.

A further type adds a line to ``_READERS`` and registers with the functions below.
"""

import math
from functools import singledispatch

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.readers import Choice, Node, Unreadable
from deformable_manipulation.scenario.fabric import (
    FabricSpec,
    fabric_free_length,
    fabric_particle_position,
    read_fabric,
)
from deformable_manipulation.scenario.materials import read_with_material
from deformable_manipulation.scenario.rod import (
    RodSpec,
    read_rod,
    rod_free_length,
    rod_particle_position,
)

_READERS = {"rod": read_rod, "fabric": read_fabric}
_TYPE = Choice(*_READERS)

_ROD_SUBSTEPS = 2  # for the direct solver
_FABRIC_SUBSTEP = 1e-3  # s; one iteration per substep is all that a fabric's constraints get
_ROUNDING = 1e-6  # of a substep


def read_object(node: Node):
    """Read and check the ``object`` section, as its ``type`` demands."""
    if not isinstance(node.value, dict):
        node.fail("must be a section with type ({}) and its keys".format(_TYPE.allowed))
    if "type" not in node.value:
        node.report.add(node.path + ("type",), "is missing; give {}".format(_TYPE.allowed))
        raise Unreadable
    kind = _TYPE(node.child("type", node.value["type"]))
    return read_with_material(node, kind, _READERS[kind])


@singledispatch
def particle_position(spec, particle: int) -> Vector:
    """Position [m] of a particle on the undeformed object, in the fixed frame."""
    raise TypeError("no geometry for objects of {}".format(type(spec).__name__))


@singledispatch
def free_length(spec, first: int, second: int) -> float:
    """Greatest distance [m] between two particles that does not stretch the object."""
    raise TypeError("no geometry for objects of {}".format(type(spec).__name__))


@singledispatch
def auto_substeps(spec, time_step: float) -> int:
    """Substeps per time step [s] that suit the object: ``simulation.substeps: auto``."""
    raise TypeError("no substeps for objects of {}".format(type(spec).__name__))


particle_position.register(RodSpec, rod_particle_position)
particle_position.register(FabricSpec, fabric_particle_position)
free_length.register(RodSpec, rod_free_length)
free_length.register(FabricSpec, fabric_free_length)


@auto_substeps.register(RodSpec)
def _rod_substeps(spec, time_step: float) -> int:
    return _ROD_SUBSTEPS


@auto_substeps.register(FabricSpec)
def _fabric_substeps(spec, time_step: float) -> int:
    return math.ceil(time_step / _FABRIC_SUBSTEP - _ROUNDING)
