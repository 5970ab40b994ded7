"""The layout of ``sensor_msgs/PointCloud2`` messages, read without ROS."""

from typing import Any, NamedTuple, Sequence

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.mesh_formats.numbers_in_text import shown

MOST_POINTS = 20_000_000
_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}  # by datatype


class _Field(NamedTuple):
    """Where a field is in the record of a point."""

    offset: int  # bytes
    type: np.dtype


def columns(message: Any, names: Sequence[str] = ("x", "y", "z")) -> np.ndarray:
    """Fields of all points (N, K), row by row of the image; nothing is left out.

    The message may have any other fields, in any order, with gaps, of either byte order.

    Args:
        message: ``sensor_msgs/PointCloud2``, or what has its attributes.
        names: of the K fields.

    Returns:
        Of single precision if all the fields are, otherwise of double.

    Raises:
        FormatError: a field is missing, the layout contradicts itself, the data are cut off, or
            there are more than MOST_POINTS.
    """
    width, height = int(message.width), int(message.height)
    if width * height > MOST_POINTS:
        text = "it has {} points; at most {} can be read"
        raise FormatError(text.format(width * height, MOST_POINTS))
    fields = [_field(message, name) for name in names]
    _check_sizes(message, names, fields)
    is_single = all(field.type.kind == "f" and field.type.itemsize == 4 for field in fields)
    result = np.empty((height, width, len(names)), np.float32 if is_single else np.float64)
    if result.size:
        strides = (_row_step(message), int(message.point_step))
        for column, field in enumerate(fields):
            result[:, :, column] = np.ndarray(
                (height, width), field.type, message.data, field.offset, strides
            )
    return result.reshape(-1, len(names))


def _field(message: Any, name: str) -> _Field:
    found = [field for field in message.fields if field.name == name]
    if len(found) != 1:
        there = ", ".join(shown(field.name) for field in message.fields) or "none"
        text = "it has {} field {}; its fields: {}"
        raise FormatError(text.format("no" if not found else "more than one", name, there))
    if found[0].datatype not in _TYPES:
        text = "its field {} has the datatype {}; it must be one of 1 to 8"
        raise FormatError(text.format(name, found[0].datatype))
    order = ">" if message.is_bigendian else "<"
    return _Field(int(found[0].offset), np.dtype(order + _TYPES[found[0].datatype]))


def _row_step(message: Any) -> int:
    """Bytes from one row to the next; of a single row, some publishers do not tell it."""
    single = int(message.height) == 1
    return int(message.width) * int(message.point_step) if single else int(message.row_step)


def _check_sizes(message: Any, names: Sequence[str], fields: Sequence[_Field]) -> None:
    width, height = int(message.width), int(message.height)
    point_step, row_step = int(message.point_step), _row_step(message)
    for name, field in zip(names, fields):
        if field.offset + field.type.itemsize > point_step:
            text = "its point_step is {}, but its field {} ends at byte {}"
            raise FormatError(text.format(point_step, name, field.offset + field.type.itemsize))
    if width * height == 0:
        return
    if row_step < width * point_step:
        text = "its row_step is {}, but {} points of {} bytes are {}"
        raise FormatError(text.format(row_step, width, point_step, width * point_step))
    needed = (height - 1) * row_step + width * point_step
    if len(message.data) < needed:
        text = "it has {} bytes of data, but {} x {} points take {}; it is cut off"
        raise FormatError(text.format(len(message.data), height, width, needed))
