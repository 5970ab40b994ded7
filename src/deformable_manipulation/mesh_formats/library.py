"""glTF, GLB and the other formats that Trimesh reads."""

import contextlib
import io
import json
import logging
import warnings
from typing import Any, Dict

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh
from deformable_manipulation.system.interruption import check_interruption

_SETTINGS: Dict[str, Any] = dict(process=False, maintain_order=True, skip_materials=True)
_BINARY_MARK = b"glTF"
_VERSION_2 = b"\2\0\0\0"
_PACKED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization")


def formats():
    """The endings, without a dot, of what Trimesh reads. Raises FormatError if it is missing."""
    return set(_trimesh().available_formats())


def read(data: bytes, suffix: str, path: str) -> RawMesh:
    """The parts of a scene, merged where they are placed.

    Args:
        data: the file.
        suffix: its ending, without a dot.
        path: of the file, to find others that it names.

    Raises:
        FormatError: with what is wrong.
    """
    trimesh = _trimesh()
    if suffix in ("gltf", "glb"):
        _check_gltf(data, suffix)
    resolver = trimesh.resolvers.FilePathResolver(path)
    try:
        with _silence():
            scene = trimesh.load_scene(io.BytesIO(data), suffix, resolver=resolver, **_SETTINGS)
            mesh = scene.to_mesh()
            return RawMesh(np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces))
    except FileNotFoundError as error:
        text = "a file that it needs is missing: {}".format(error.filename or error)
    except Exception:  # whatever the parser of this format stumbles over
        text = "it is broken, or no {} file, or uses a feature that cannot be read"
        text = text.format(suffix.upper())
    raise FormatError(text)


def _trimesh():
    try:
        with _silence():
            import trimesh  # takes long to import, and not every run needs it
    except ImportError:
        check_interruption()
        raise FormatError("this format needs the Python package trimesh") from None
    check_interruption()  # which Trimesh keeps to itself
    return trimesh


@contextlib.contextmanager
def _silence():
    """What the library warns of does not concern the user."""
    logger = logging.getLogger("trimesh")
    was_disabled, logger.disabled = logger.disabled, True
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.disabled = was_disabled


def _check_gltf(data: bytes, suffix: str) -> None:
    """Refuse what Trimesh would read wrongly, or fail on without a reason."""
    text = data
    if suffix == "glb":
        if data[:4] != _BINARY_MARK:
            raise FormatError("it is no GLB file, which begins with 'glTF'")
        if data[4:8] != _VERSION_2:
            raise FormatError("it is not of glTF version 2; export it as that")
        text = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    try:
        document = json.loads(text.decode("utf-8-sig"))
        version = str(document.get("asset", {}).get("version", ""))
    except (ValueError, AttributeError) as error:
        raise FormatError("its JSON is broken: {}".format(error)) from None
    if not version.startswith("2"):
        raise FormatError("it is of glTF version {!r}; export it as version 2".format(version))
    packed = [name for name in _PACKED if name in document.get("extensionsRequired", ())]
    if packed:
        raise FormatError("it uses {}; export it without".format(", ".join(packed)))
