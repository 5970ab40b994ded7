"""Text files that a user names: what cannot be one is refused at once."""

import os

import pytest

from deformable_manipulation.system.text_files import TextFileError, read_text


def test_text_without_byte_order_mark(tmp_path):
    path = tmp_path / "text"
    path.write_bytes("\ufeffgr\u00fcn\n".encode("utf-8"))
    assert read_text(path) == "gr\u00fcn\n"


def test_files_behind_links(tmp_path):
    (tmp_path / "text").write_text("a")
    (tmp_path / "link").symlink_to(tmp_path / "text")
    assert read_text(tmp_path / "link") == "a"


def test_the_largest_size(tmp_path):
    path = tmp_path / "text"
    path.write_bytes(b"1234")
    assert read_text(path, largest=4) == "1234"
    with pytest.raises(TextFileError, match="more than 3 bytes"):
        read_text(path, largest=3)


@pytest.fixture
def pipe(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(str(path))
    return path


def test_pipes_are_not_waited_for(pipe):
    with pytest.raises(TextFileError, match="not a regular file"):
        read_text(pipe)


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null"])
def test_devices(device):
    with pytest.raises(TextFileError, match="not a regular file"):
        read_text(device)


@pytest.mark.parametrize(
    "name, expected",
    [
        (".", "Is a directory"),
        ("absent", "No such file"),
        ("a" * 300, "File name too long"),
        ("a\0b", "null"),
    ],
)
def test_names_of_no_file(tmp_path, name, expected):
    with pytest.raises(TextFileError, match=expected):
        read_text(tmp_path / name)


def test_other_encodings(tmp_path):
    path = tmp_path / "text"
    for mark in (b"", b"\xef\xbb\xbf"):
        path.write_bytes(mark + b"ab\xff")
        text = f"is not UTF-8 text: its byte {len(mark) + 3} has the value 255"
        with pytest.raises(TextFileError, match=text):
            read_text(path)
