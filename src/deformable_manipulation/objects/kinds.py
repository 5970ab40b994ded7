"""The kinds of objects that there are, by the word at the ``type`` of the section ``object``."""

from typing import Any, Callable, Dict, NamedTuple

from deformable_manipulation.objects.fabric import FABRIC, read_fabric
from deformable_manipulation.objects.materials import read_with_material
from deformable_manipulation.objects.rod import ROD, read_rod
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.reading.readers import Choice, Node, Section, Unreadable


class Kind(NamedTuple):
    """A kind of object.

    Attributes:
        section: its keys.
        read: reads and checks its section.
    """

    section: Section
    read: Callable[[Node], ObjectSpec]


KINDS: Dict[str, Kind] = {"rod": Kind(ROD, read_rod), "fabric": Kind(FABRIC, read_fabric)}
_TYPE = Choice(*KINDS)


def read_object(node: Node) -> Any:
    """Read and check the ``object`` section, as its ``type`` demands."""
    if not isinstance(node.value, dict):
        node.fail("must be a section with type ({}) and its keys".format(_TYPE.allowed))
    if "type" not in node.value:
        node.report.add(node.path + ("type",), "is missing; give {}".format(_TYPE.allowed))
        raise Unreadable
    kind = _TYPE(node.child("type", node.value["type"]))
    return read_with_material(node, kind, KINDS[kind].read)
