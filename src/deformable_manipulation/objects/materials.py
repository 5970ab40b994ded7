"""Material presets: keys of the ``object`` section that a scenario takes by a material's name."""

import dataclasses
from functools import lru_cache
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping

import yaml

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Node, Unreadable, nearest
from deformable_manipulation.system.package_files import package_share_directory

NOTES = ("about", "source")  # what a preset has beside keys of the object


def kinds_with_presets() -> List[str]:
    """Kinds of objects that there are presets for."""
    return sorted(path.stem for path in _folder().glob("*.yaml"))


def _folder() -> Path:
    return package_share_directory() / "config" / "materials"


@lru_cache(maxsize=None)
def presets(kind: str) -> Mapping[str, Mapping[str, Any]]:
    """All presets for objects of a kind, by name, with their NOTES: ``config/materials/KIND.yaml``.

    Not to be changed. None if there is no such file.
    """
    path = _folder() / "{}.yaml".format(kind)
    if not path.is_file():
        return {}
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def preset_values(kind: str, name: str) -> Dict[str, Any]:
    """The keys of the ``object`` section that a preset gives."""
    return {key: item for key, item in presets(kind)[name].items() if key not in NOTES}


def read_with_material(node: Node, kind: str, read: Callable[[Node], Any]):
    """Read an ``object`` section after its ``material`` gave the keys that the section lacks.

    Args:
        node: the section, a mapping.
        read: reader of the section without ``material``.
    """
    if "material" not in node.value:
        return read(node)
    given = {key: item for key, item in node.value.items() if key != "material"}
    material = node.child("material", node.value["material"])
    known = presets(kind)
    if isinstance(material.value, str) and material.value in known:
        return read(_filled(node, kind, material.value, given))
    material.report.add(material.path, _unknown(material.value, kind), show(material.value))
    # With any preset in its place, the section's other mistakes are found, and no false ones.
    if known:
        read(_filled(node, kind, next(iter(known)), given))
    raise Unreadable


def _filled(node: Node, kind: str, name: str, given: Mapping[str, Any]) -> Node:
    return dataclasses.replace(node, value={**preset_values(kind, name), **given})


def _unknown(value, kind: str) -> str:
    for other in kinds_with_presets():
        if other != kind and isinstance(value, str) and value in presets(other):
            hint = " it is a material of type {};".format(other)
            break
    else:
        hint = nearest(value, presets(kind)) if isinstance(value, str) else ""
    return "is not a known material of type {};{} known: {}".format(
        kind, hint, ", ".join(presets(kind)) or "none; remove it, and give its values"
    )
