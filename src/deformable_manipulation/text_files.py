"""Reading files that a user names, whatever the name may turn out to stand for."""

import os
import stat

LARGEST_FILE = 16_000_000  # bytes, some hundred times what any file read here needs


class TextFileError(ValueError):
    """A file cannot be read; the message says why, without the file's name."""


def read_text(path, largest: int = LARGEST_FILE) -> str:
    """The content of a regular file of UTF-8 text, without a byte order mark.

    Devices and pipes are refused instead of read: they may have no end, or never answer.

    Raises TextFileError: there is no such file, it may not be read, is no regular file, has more
    than ``largest`` bytes, or is not UTF-8.
    """
    data = read_bytes(path, largest)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise TextFileError("is not UTF-8 text: {}".format(error)) from error


def read_bytes(path, largest: int) -> bytes:
    """The content of a regular file. Raises TextFileError as read_text does."""
    try:
        data = _read_regular(path, largest + 1)
    except OSError as error:
        raise TextFileError("cannot be read: {}".format(error.strerror or error)) from error
    except ValueError as error:  # a path with a null character
        raise TextFileError("cannot be read: {}".format(error)) from error
    if len(data) > largest:
        raise TextFileError("has more than {} bytes; is it the right file?".format(largest))
    return data


def _read_regular(path, count: int) -> bytes:
    """Up to ``count`` bytes of a regular file."""
    # Opening a pipe would wait for somebody to write into it.
    with open(str(path), "rb", opener=_open_without_waiting) as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise TextFileError("is no regular file, but a device, a pipe or the like")
        return file.read(count)


def _open_without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | os.O_NONBLOCK)
