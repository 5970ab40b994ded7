"""Decompression of LZF, which compressed PCD files use."""

from deformable_manipulation.mesh_formats.faces import FormatError

_LITERALS = 32  # control bytes below it: so many bytes follow, and one more
_LONG = 7  # length of a repetition that goes on in the next byte


def decompressed(data: bytes, size: int) -> bytes:
    """The bytes that were compressed.

    Args:
        data: what was written of them.
        size: how many bytes they are.

    Raises:
        FormatError: that is not what the data hold.
    """
    result = bytearray()
    place = 0
    try:
        while place < len(data) and len(result) <= size:
            control = data[place]
            place += 1
            if control < _LITERALS:
                result += data[place : place + control + 1]
                place += control + 1
                continue
            length = control >> 5
            if length == _LONG:
                length += data[place]
                place += 1
            start = len(result) - ((control & 31) << 8) - data[place] - 1
            place += 1
            _repeat(result, start, length + 2)
    except IndexError:
        result.clear()
    if len(result) != size:
        raise FormatError("its compressed data are broken, or cut off")
    return bytes(result)


def _repeat(result: bytearray, start: int, length: int) -> None:
    """Append what begins at an earlier place; it may reach into what is appended."""
    if start < 0:
        raise IndexError
    piece = result[start : start + length]
    while len(piece) < length:
        piece += piece[: length - len(piece)]
    result += piece
