"""The ``object`` section: one reader and one geometry per type of object.

A further type adds a line to ``_READERS`` and registers its geometry with the two functions below.
"""

from functools import singledispatch

from deformable_manipulation.scenario.readers import Choice, Node, Unreadable
from deformable_manipulation.scenario.rod import (
    read_rod,
    rod_free_length,
    rod_particle_position,
)
from deformable_manipulation.scenario.spec import RodSpec, Vector

_READERS = {"rod": read_rod}
_TYPE = Choice(*_READERS)


def read_object(node: Node):
    """Read and check the ``object`` section, as its ``type`` demands."""
    if not isinstance(node.value, dict):
        node.fail("must be a section with type ({}) and its keys".format(_TYPE.allowed))
    if "type" not in node.value:
        node.report.add(node.path + ("type",), "is missing; give {}".format(_TYPE.allowed))
        raise Unreadable
    return _READERS[_TYPE(node.child("type", node.value["type"]))](node)


@singledispatch
def particle_position(spec, particle: int) -> Vector:
    """Position [m] of a particle on the undeformed object, in the fixed frame."""
    raise TypeError("no geometry for objects of {}".format(type(spec).__name__))


@singledispatch
def free_length(spec, first: int, second: int) -> float:
    """Greatest distance [m] between two particles that does not stretch the object."""
    raise TypeError("no geometry for objects of {}".format(type(spec).__name__))


particle_position.register(RodSpec, rod_particle_position)
free_length.register(RodSpec, rod_free_length)
