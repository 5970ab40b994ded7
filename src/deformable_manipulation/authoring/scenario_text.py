"""The text of a scenario's file under another name and in another folder."""

import os
from pathlib import Path
from typing import Dict, Optional

from deformable_manipulation.authoring.yaml_edit import KeyPath, replace_scalars, scalars
from deformable_manipulation.system.package_files import PACKAGE, package_share_directory

FILE_KEYS = ("polygon", "mesh")
_MATERIAL = ("object", "material")


class NoMaterial(ValueError):
    """The scenario has no material to replace."""


def moved_text(
    text: str, source: Path, target: Path, name: str, material: Optional[str] = None
) -> str:
    """A scenario's text for another file; comments and everything else stay as they are.

    Args:
        text: content of ``source``.
        target: the other file; the files that the scenario names are found from there, too.
        name: of the scenario.
        material: in place of that of the object, if it is given.

    Raises:
        NoMaterial: there is none to replace.
    """
    found = scalars(text)
    values: Dict[KeyPath, str] = {
        path: _from(target.parent, source.parent, value)
        for path, value in found.items()
        if path[-1:] and path[-1] in FILE_KEYS
    }
    values[("name",)] = name
    if material is not None:
        if _MATERIAL not in found:
            raise NoMaterial
        values[_MATERIAL] = material
    return replace_scalars(text, values)


def _from(folder: Path, old_folder: Path, file: str) -> str:
    """The name of a file as a scenario in another folder writes it."""
    if file.startswith("package://") or os.path.isabs(file):
        return file
    path = Path(os.path.abspath(str(old_folder / file)))
    share = package_share_directory()
    if share in path.parents:
        return "package://{}/{}".format(PACKAGE, path.relative_to(share).as_posix())
    return os.path.relpath(str(path), os.path.abspath(str(folder)))
