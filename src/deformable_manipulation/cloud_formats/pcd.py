"""PCD files of the Point Cloud Library, text, binary and compressed."""

from typing import Dict, List, NamedTuple, Tuple

import numpy as np

from deformable_manipulation.cloud_formats.lzf import decompressed
from deformable_manipulation.cloud_formats.text import table
from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.mesh_formats.numbers_in_text import shown

_KINDS = {"F": "f", "I": "i", "U": "u"}
_LONGEST_HEADER = 1 << 16  # bytes
_MOST_COLUMNS = 10_000


class _Field(NamedTuple):
    name: str
    type: str  # of numpy
    repeated: int  # so many numbers each


class _Header(NamedTuple):
    fields: List[_Field]
    points: int
    data: str
    begin: int  # where the points do


def read(data: bytes) -> np.ndarray:
    """The points (N, 3) of the fields x, y and z.

    Raises:
        FormatError: with the line of the header, or of the points.
    """
    header = _header(data)
    names = [field.name for field in header.fields]
    missing = [axis for axis in "xyz" if axis not in names]
    if missing:
        raise FormatError("it has no field {}".format(", ".join(missing)))
    if header.data == "ascii":
        return _from_text(data, header)
    if header.data == "binary":
        return _from_records(data[header.begin :], header)
    return _from_columns(data, header)


def _header(data: bytes) -> _Header:
    lines: Dict[str, List[str]] = {}
    place = 0
    while "DATA" not in lines:
        end = data.find(b"\n", place, _LONGEST_HEADER)
        if end < 0:
            raise FormatError("its header has no end, a line 'DATA'")
        words = data[place:end].decode("latin-1").partition("#")[0].split()
        place = end + 1
        if words:
            lines[words[0].upper()] = words[1:]
    try:
        fields = _fields(lines)
        width, height = int(lines["WIDTH"][0]), int(lines["HEIGHT"][0])
        points = int(lines["POINTS"][0]) if "POINTS" in lines else width * height
        form = lines["DATA"][0].lower()
    except (KeyError, IndexError, ValueError) as error:
        text = "its header cannot be understood: {} is missing or wrong"
        raise FormatError(text.format(shown(str(error)))) from None
    if points < 0 or form not in ("ascii", "binary", "binary_compressed"):
        raise FormatError("its header cannot be understood: POINTS or DATA is wrong")
    return _Header(fields, points, form, place)


def _fields(lines: Dict[str, List[str]]) -> List[_Field]:
    names = lines["FIELDS"] if "FIELDS" in lines else lines["COLUMNS"]
    counts = [int(count) for count in lines.get("COUNT", ["1"] * len(names))]
    types = [_KINDS[kind] + size for kind, size in zip(lines["TYPE"], lines["SIZE"])]
    if not len(names) == len(types) == len(counts):
        raise ValueError("the number of FIELDS, SIZE, TYPE and COUNT")
    if min(counts) < 1 or sum(counts) > _MOST_COLUMNS:
        raise ValueError("COUNT")
    for each in types:
        np.dtype("<" + each)
    return [_Field(*each) for each in zip(names, types, counts)]


def _from_text(data: bytes, header: _Header) -> np.ndarray:
    starts = np.cumsum([0] + [field.repeated for field in header.fields])
    rows = table(data[header.begin :].decode("latin-1"), data.count(b"\n", 0, header.begin))
    if len(rows) < header.points:
        raise FormatError(_cut_off(len(rows), header.points))
    if rows.shape[1:] != (starts[-1],) and len(rows):
        text = "its points have {} numbers, and its header has fields for {}"
        raise FormatError(text.format(rows.shape[1], starts[-1]))
    names = [field.name for field in header.fields]
    return rows[: header.points, [starts[names.index(axis)] for axis in "xyz"]]


def _from_records(data: bytes, header: _Header) -> np.ndarray:
    record = np.dtype(
        [
            ("{} {}".format(index, field.name), "<" + field.type, (field.repeated,))
            for index, field in enumerate(header.fields)
        ]
    )
    complete = len(data) // record.itemsize
    if complete < header.points:
        raise FormatError(_cut_off(complete, header.points))
    points = np.frombuffer(data, record, header.points)
    return _stacked({field.name: points[name][:, 0] for field, name in _named(header, record)})


def _from_columns(data: bytes, header: _Header) -> np.ndarray:
    """Compressed, with all values of one field after another."""
    sizes = np.frombuffer(data[header.begin : header.begin + 8], "<u4")
    whole = (
        sum(np.dtype(each.type).itemsize * each.repeated for each in header.fields) * header.points
    )
    if len(sizes) != 2 or sizes[1] != whole or len(data) - header.begin - 8 < sizes[0]:
        raise FormatError("its compressed data are cut off, or not what its header says")
    begin = header.begin + 8
    values = decompressed(data[begin : begin + int(sizes[0])], whole)
    columns, place = {}, 0
    for field in header.fields:
        column = np.frombuffer(values, "<" + field.type, header.points * field.repeated, place)
        columns[field.name] = column[:: field.repeated]
        place += column.nbytes
    return _stacked(columns)


def _named(header: _Header, record: np.dtype) -> List[Tuple[_Field, str]]:
    return list(zip(header.fields, record.names or ()))


def _stacked(columns: Dict[str, np.ndarray]) -> np.ndarray:
    return np.stack([columns[axis] for axis in "xyz"], axis=1)


def _cut_off(found: int, promised: int) -> str:
    return "it ends after {} of the {} points that its header promises; it is cut off".format(
        found, promised
    )
