"""The values after the header of a PLY file, element by element."""

from typing import Any, List, Sequence, Tuple, Union

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.mesh_formats.numbers_in_text import number_of, shown

Kind = Tuple[str, str]  # numpy's types of the values and, of a list, of its length
Column = Union[np.ndarray, Tuple[np.ndarray, np.ndarray]]  # of a list: lengths, values


class BinaryValues:
    """Values as bytes.

    Args:
        data: the file.
        begin: where the values begin.
        order: '<' or '>', of the bytes of a value.
    """

    def __init__(self, data: bytes, begin: int, order: str):
        self._data, self._place, self._order = data, begin, order

    def read(self, count: int, kinds: Sequence[Kind]) -> List[Column]:
        """The properties of the next ``count`` items.

        Raises:
            EOFError: the file ends within the item that the error names.
        """
        start = self._place
        lengths = [len(values) for values in self._item(kinds, 0)] if count else [0] * len(kinds)
        self._place = start
        record = self._record(lengths, kinds)
        if self._place + count * record.itemsize <= len(self._data):
            table = np.frombuffer(self._data, dtype=record, count=count, offset=self._place)
            # Mostly, all lists have the length of the first.
            if all((table[name] == length).all() for name, length in _told(lengths, kinds)):
                self._place += count * record.itemsize
                return [_column(table, k, kind) for k, kind in enumerate(kinds)]
        items = [self._item(kinds, index) for index in range(count)]
        return _columns(items, kinds)

    def _record(self, lengths: Sequence[int], kinds: Sequence[Kind]) -> np.dtype:
        """An item whose lists have these lengths."""
        fields = []
        for k, (length, (kind, length_kind)) in enumerate(zip(lengths, kinds)):
            if length_kind:
                fields.append((_length_name(k), self._order + length_kind, (1,)))
            fields.append((_value_name(k), self._order + kind, (length,)))
        return np.dtype(fields)

    def _item(self, kinds: Sequence[Kind], index: int) -> List[np.ndarray]:
        return [
            self._next(int(self._next(1, length, index)[0]) if length else 1, kind, index)
            for kind, length in kinds
        ]

    def _next(self, count: int, kind: str, index: int) -> np.ndarray:
        of_kind = np.dtype(self._order + kind)
        if count < 0:
            raise FormatError("a list in its item {} has {} values".format(index, count))
        if self._place + count * of_kind.itemsize > len(self._data):
            raise EOFError(index)
        values = np.frombuffer(self._data, dtype=of_kind, count=count, offset=self._place)
        self._place += count * of_kind.itemsize
        return values


class TextValues:
    """Values as words, each item on a line of its own; further words there are passed over.

    Args:
        data: the file.
        begin: where the values begin.
    """

    def __init__(self, data: bytes, begin: int):
        before = data.count(b"\n", 0, begin)
        lines = enumerate(data[begin:].decode("latin-1").splitlines(), start=before + 1)
        self._rows = ((number, line.split()) for number, line in lines if line.strip())

    def read(self, count: int, kinds: Sequence[Kind]) -> List[Column]:
        """The properties of the next ``count`` items.

        Raises:
            EOFError: the file ends within the item that the error names.
            FormatError: a line is not of the element; with its number.
        """
        rows = [row for _, row in zip(range(count), self._rows)]
        if len(rows) < count:
            raise EOFError(len(rows))
        alike = _alike_columns([words for _, words in rows], kinds)
        if alike:
            return alike
        return _columns([_item(words, kinds, number) for number, words in rows], kinds)


def _alike_columns(rows: Sequence[List[str]], kinds: Sequence[Kind]) -> List[Column]:
    """The columns of rows that all look like the first; none where some do not."""
    if not rows or any(len(words) != len(rows[0]) for words in rows):
        return []
    try:
        lengths = [len(values) for values in _item(rows[0], kinds, 0)]
        table = np.array(rows, dtype=float)
    except (ValueError, FormatError):
        return []
    columns: List[Column] = []
    at = 0
    for length, (_, length_kind) in zip(lengths, kinds):
        if length_kind:
            if (table[:, at] != length).any():
                return []
            columns.append((table[:, at], table[:, at + 1 : at + 1 + length].reshape(-1)))
            at += 1 + length
        else:
            columns.append(table[:, at])
            at += 1
    return columns


def _item(words: List[str], kinds: Sequence[Kind], line: int) -> List[List[float]]:
    """The values of each property on a line."""
    item, at = [], 0
    try:
        for _, length_kind in kinds:
            count = 1
            if length_kind:
                count, at = int(words[at]), at + 1
            item.append([float(word) for word in words[at : at + count]])
            at += count
        if 0 <= at <= len(words):
            return item
    except (ValueError, IndexError):
        pass
    wrong = [word for word in words if number_of(word) is None]
    if wrong:
        raise FormatError("line {}: {} is no number".format(line, shown(wrong[0])))
    text = "line {}: {} are not the values that the header tells of"
    raise FormatError(text.format(line, shown(" ".join(words))))


def _columns(items: Sequence[Sequence[Any]], kinds: Sequence[Kind]) -> List[Column]:
    columns: List[Column] = []
    for k, (_, length_kind) in enumerate(kinds):
        lengths = np.array([len(item[k]) for item in items], dtype=np.int64)
        values = np.concatenate([np.empty(0), *(item[k] for item in items)])
        columns.append((lengths, values) if length_kind else values)
    return columns


def _column(table: np.ndarray, k: int, kind: Kind) -> Column:
    values = table[_value_name(k)].reshape(-1)
    return (table[_length_name(k)].reshape(-1), values) if kind[1] else values


def _told(lengths: Sequence[int], kinds: Sequence[Kind]) -> List[Tuple[str, int]]:
    """The lists: the names of their lengths, and these."""
    return [
        (_length_name(k), length) for k, (length, kind) in enumerate(zip(lengths, kinds)) if kind[1]
    ]


def _length_name(k: int) -> str:
    return "length {}".format(k)


def _value_name(k: int) -> str:
    return "values {}".format(k)
