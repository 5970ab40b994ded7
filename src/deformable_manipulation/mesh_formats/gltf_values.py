"""The JSON of glTF files and the numbers in their buffers."""

import base64
import binascii
import json
import os
from typing import Any, Dict, Optional, Tuple
from urllib.parse import unquote

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.system.text_files import TextFileError, read_bytes

_MARK = b"glTF"
_HEADER = 12  # bytes
_JSON, _BINARY = b"JSON", b"BIN\0"  # kinds of chunks
_LARGEST_BUFFER = 1_000_000_000  # bytes
_TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def item_of(document: Dict[str, Any], kind: str, index: Any, owner: str) -> Dict[str, Any]:
    """An item of one of the document's lists. Raises FormatError where there is none."""
    items = document.get(kind, [])
    if not isinstance(index, int) or not 0 <= index < len(items):
        text = "{} refers to {} of '{}', and there are {}"
        raise FormatError(text.format(owner, index, kind, len(items)))
    if not isinstance(items[index], dict):
        raise FormatError("item {} of '{}' is no object".format(index, kind))
    return items[index]


class GltfFile:
    """A document and its buffers.

    Args:
        data: the file; of GLB if it begins with 'glTF'.
        path: of the file, beside which its buffers are.

    Raises:
        FormatError: with what is wrong.
    """

    def __init__(self, data: bytes, path: str):
        text, self._chunk = _chunks(data) if data[:4] == _MARK else (data, None)
        self._directory = os.path.dirname(path)
        self._buffers: Dict[int, bytes] = {}
        try:
            self.document: Dict[str, Any] = json.loads(text.decode("utf-8-sig"))
            version = str(self.document.get("asset", {}).get("version", ""))
        except (ValueError, AttributeError, RecursionError) as error:
            raise FormatError(
                "it is no GLB file, which begins with 'glTF', and no JSON: {}".format(error)
            ) from None
        if not version.startswith("2"):
            raise FormatError("it is of glTF version {!r}; export it as version 2".format(version))

    def accessor(self, index: int, type_name: str) -> np.ndarray:
        """The values (N, width) of an accessor. Raises FormatError.

        Args:
            index: of the accessor.
            type_name: that it must have, such as "VEC3".
        """
        accessor = item_of(self.document, "accessors", index, "a mesh")
        if accessor.get("type") != type_name:
            text = "accessor {} is of type {}, not {}"
            raise FormatError(text.format(index, accessor.get("type"), type_name))
        count, width = accessor["count"], _WIDTHS[type_name]
        kind = self._kind(accessor, index)
        values = np.zeros((count, width), dtype=kind)
        if "bufferView" in accessor:
            values = self._values(accessor, count, width, kind, index)
        if "sparse" in accessor:
            values = self._replaced(values, accessor["sparse"], index)
        if accessor.get("normalized") and kind.kind in "iu":
            return np.maximum(values / np.iinfo(kind).max, -1.0)
        return values

    def _kind(self, holder: Dict[str, Any], index: int) -> np.dtype:
        component = holder.get("componentType")
        if component not in _TYPES:
            text = "accessor {} has components of the unknown type {}"
            raise FormatError(text.format(index, component))
        return np.dtype(_TYPES[component])

    def _replaced(self, values: np.ndarray, sparse: Dict[str, Any], index: int) -> np.ndarray:
        """The values, some of them others."""
        count, places, others = sparse["count"], sparse["indices"], sparse["values"]
        where = self._values(places, count, 1, self._kind(places, index), index).reshape(-1)
        if count and where.max() >= len(values):
            raise FormatError("accessor {} replaces values that there are not".format(index))
        values = values.copy()
        values[where] = self._values(others, count, values.shape[1], values.dtype, index)
        return values

    def _values(
        self, holder: Dict[str, Any], count: int, width: int, kind: np.dtype, index: int
    ) -> np.ndarray:
        """Values (count, width) from where an accessor says that they are."""
        view = item_of(self.document, "bufferViews", holder["bufferView"], "an accessor")
        buffer = self._buffer(view["buffer"])
        begin = view.get("byteOffset", 0) + holder.get("byteOffset", 0)
        size = width * kind.itemsize
        stride = view.get("byteStride", size)
        end = min(view.get("byteOffset", 0) + view["byteLength"], len(buffer))
        if min(begin, count) < 0 or stride < size:
            raise FormatError("accessor {} is where nothing can be".format(index))
        if count and begin + (count - 1) * stride + size > end:
            text = "accessor {} needs {} values and there are fewer; a buffer is cut off"
            raise FormatError(text.format(index, count))
        shape, strides = (count, width), (stride, kind.itemsize)
        return np.ndarray(shape, dtype=kind, buffer=buffer, offset=begin, strides=strides).copy()

    def _buffer(self, index: int) -> bytes:
        if index not in self._buffers:
            buffer = item_of(self.document, "buffers", index, "a buffer view")
            self._buffers[index] = self._content(buffer.get("uri"))
        return self._buffers[index]

    def _content(self, uri: Optional[str]) -> bytes:
        if uri is None:
            if self._chunk is None:
                raise FormatError("a buffer of it is nowhere")
            return self._chunk
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2])
            except (binascii.Error, ValueError):
                raise FormatError("a buffer in it is no base64") from None
        try:
            return read_bytes(os.path.join(self._directory, unquote(uri)), _LARGEST_BUFFER)
        except TextFileError as error:
            raise FormatError("its file '{}' {}".format(uri, error)) from None


def _chunks(data: bytes) -> Tuple[bytes, Optional[bytes]]:
    """The JSON and the buffer of a GLB file."""
    version = int.from_bytes(data[4:8], "little")
    if version != 2:
        raise FormatError("it is of glTF version {}; export it as version 2".format(version))
    chunks: Dict[bytes, bytes] = {}
    place = _HEADER
    while place + 8 <= len(data):
        length = int.from_bytes(data[place : place + 4], "little")
        kind = data[place + 4 : place + 8]
        content = data[place + 8 : place + 8 + length]
        if len(content) < length:
            raise FormatError("the file ends within its chunk {!r}; it is cut off".format(kind))
        chunks.setdefault(kind, content)
        place += 8 + length
    if _JSON not in chunks:
        raise FormatError("it has no JSON")
    return chunks[_JSON], chunks.get(_BINARY)
