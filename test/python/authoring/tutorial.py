"""The tutorial's commands and files, as a reader types them."""

import re
import shlex
from pathlib import Path

import yaml

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_FILE = re.compile(r"# (\S+)\n")
RUN = ["rosrun", "deformable_manipulation"]


def follow(page: Path, folder: Path, run, launch) -> None:
    """Do what a page says, from an empty folder.

    ``run(command, arguments, folder)`` for each command of this package and ``launch(arguments,
    folder)`` for each roslaunch.
    """
    for kind, text in _BLOCK.findall(page.read_text(encoding="utf-8")):
        if kind == "sh":
            for line in text.splitlines():
                folder = _follow_line(line, folder, run, launch)
        elif kind == "text":
            (folder / _FILE.match(text).group(1)).write_text(text)
        elif kind == "yaml":
            _change(folder / _FILE.match(text).group(1), text)


def _follow_line(line: str, folder: Path, run, launch) -> Path:
    words = shlex.split(line)
    if words[:1] == ["mkdir"]:
        name = words[1]
        assert words == ["mkdir", name, "&&", "cd", name]
        (folder / name).mkdir()
        return folder / name
    if words[:1] == ["roslaunch"]:
        launch(words[1:], folder)
    else:
        assert words[:2] == RUN, line
        run(words[2], words[3:], folder)
    return folder


def _change(path: Path, text: str) -> None:
    """Put the sections of a piece of YAML in place of those of a scenario."""
    sections = yaml.safe_load(text)
    scenario = yaml.safe_load(path.read_text())
    assert set(sections) <= set(scenario)
    path.write_text(yaml.safe_dump({**scenario, **sections}, sort_keys=False))
