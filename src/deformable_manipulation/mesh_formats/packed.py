"""Mesh files within compressed ones."""

import gzip
import io
import zipfile
import zlib
from pathlib import PurePath
from typing import Callable, Tuple

from deformable_manipulation.mesh_formats.faces import FormatError

_CHUNK = 1 << 20  # bytes


def unpacked(
    name: str, data: bytes, largest: int, is_mesh: Callable[[str], bool]
) -> Tuple[str, bytes]:
    """The name and content of the mesh in a file that ends in .gz or .zip; of others, themselves.

    Args:
        name: of the file.
        data: its content.
        largest: bytes that a mesh may have.
        is_mesh: whether the name of a file is that of a mesh.

    Raises:
        FormatError: it is broken, too large, or has other than one mesh in it.
    """
    suffix = PurePath(name).suffix.lower()
    if suffix == ".gz":
        try:
            with gzip.open(io.BytesIO(data)) as file:
                return name[: -len(suffix)], _limited(file, largest)
        except (OSError, EOFError, zlib.error) as error:
            raise FormatError("it is no gzip file, or broken ({})".format(error)) from None
    if suffix == ".zip":
        return _only_mesh(data, largest, is_mesh)
    return name, data


def open_zip(data: bytes) -> zipfile.ZipFile:
    """The archive that a file is. Raises FormatError."""
    try:
        return zipfile.ZipFile(io.BytesIO(data))
    except (zipfile.BadZipFile, OSError, ValueError) as error:
        raise FormatError("it is no ZIP archive, or broken ({})".format(error)) from None


def member(archive: zipfile.ZipFile, name: str, largest: int) -> bytes:
    """The content of a file in an archive. Raises FormatError."""
    try:
        with archive.open(name) as file:
            return _limited(file, largest)
    except (zipfile.BadZipFile, RuntimeError, NotImplementedError, OSError, zlib.error) as error:
        raise FormatError("'{}' in it cannot be read ({})".format(name, error)) from None


def _only_mesh(data: bytes, largest: int, is_mesh: Callable[[str], bool]) -> Tuple[str, bytes]:
    with open_zip(data) as archive:
        names = [
            name
            for name in archive.namelist()
            if is_mesh(name) and not name.startswith("__MACOSX/")
        ]
        if len(names) != 1:
            text = "it must have one mesh in it, and has {}{}; unpack it and name one of its files"
            listed = " ({})".format(", ".join(names[:5])) if names else ""
            raise FormatError(text.format(len(names), listed))
        return names[0], member(archive, names[0], largest)


def _limited(file, largest: int) -> bytes:
    parts, size = [], 0
    for part in iter(lambda: file.read(_CHUNK), b""):
        parts.append(part)
        size += len(part)
        if size > largest:
            raise FormatError("unpacked it has more than {} bytes".format(largest))
    return b"".join(parts)
