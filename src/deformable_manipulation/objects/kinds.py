"""The kinds of objects, by their words in the scenario."""

from typing import Dict, Type

from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.materials import read_with_material
from deformable_manipulation.objects.object_spec import ObjectSpec
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.reading.readers import Choice, Node, Unreadable

KINDS: Dict[str, Type[ObjectSpec]] = {kind.type: kind for kind in (RodSpec, FabricSpec)}
_TYPE = Choice(*KINDS)


def read_object(node: Node) -> ObjectSpec:
    """Read and check the ``object`` section, as its ``type`` demands."""
    if not isinstance(node.value, dict):
        node.fail("must be a section with type ({}) and its keys".format(_TYPE.allowed))
    if "type" not in node.value:
        node.report.add(node.path + ("type",), "is missing; give {}".format(_TYPE.allowed))
        raise Unreadable
    kind = _TYPE(node.child("type", node.value["type"]))
    return read_with_material(node, kind, KINDS)
