"""Reading files that a user names, whatever the name may turn out to stand for."""

import contextlib
import os
import stat
from typing import IO, Iterator

LARGEST_FILE = 16_000_000  # bytes, some hundred times what any file read here needs


class TextFileError(ValueError):
    """A file cannot be read; the message says why, without the file's name."""


def read_text(path, largest: int = LARGEST_FILE) -> str:
    """The content of a regular file of UTF-8 text, without a byte order mark.

    Devices and pipes are refused instead of read: they may have no end, or never answer.

    Raises:
        TextFileError: there is no such file, it may not be read, is no regular file, has more than
            ``largest`` bytes, or is not UTF-8.
    """
    data = read_bytes(path, largest)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        byte = (
            len(data) - len(error.object) + error.start
        )  # of which a mark at the start is left out
        text = "is not UTF-8 text: its byte {} has the value {}"
        raise TextFileError(text.format(byte + 1, data[byte])) from error


def read_bytes(path, largest: int) -> bytes:
    """The content of a regular file. Raises TextFileError as read_text does."""
    data = read_start(path, largest + 1)
    if len(data) > largest:
        raise TextFileError("has more than {} bytes; is it the right file?".format(largest))
    return data


@contextlib.contextmanager
def open_regular(path) -> Iterator[IO[bytes]]:
    """Open a regular file to read its bytes, for the time of a with statement.

    Raises:
        OSError: it cannot be read.
        TextFileError: it is a device, a pipe or the like.
    """
    # Opening a pipe would wait for somebody to write into it.
    with open(str(path), "rb", opener=_open_without_waiting) as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise TextFileError("is not a regular file but a device, a pipe or similar")
        yield file


def read_start(path, count: int) -> bytes:
    """The first ``count`` bytes of a regular file. Raises TextFileError as read_text does."""
    try:
        with open_regular(path) as file:
            return file.read(count)
    except TextFileError:
        raise
    except OSError as error:
        raise TextFileError("cannot be read: {}".format(error.strerror or error)) from error
    except ValueError as error:  # a path with a null character
        raise TextFileError("cannot be read: {}".format(error)) from error


def _open_without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | os.O_NONBLOCK)
