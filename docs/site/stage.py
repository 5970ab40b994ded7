"""Puts together what Sphinx reads: ``stage.py CHECKOUT DOXYGEN_XML FOLDER``.

The pages of docs/ and some of the top level, with links that hold on the site, and a page of the
API for every folder of modules and headers.
"""

import os
import re
import shutil
import sys
from functools import partial
from pathlib import Path

from cpp_pages import cpp_page

PACKAGE = "deformable_manipulation"
# Pages that lie outside docs/, by their place in the checkout.
PAGES = {
    "README.md": "overview.md",
    "CHANGELOG.rst": "changelog.rst",
    "CONTRIBUTING.md": "contributing.md",
    "examples/README.md": "examples.md",
}
# Programs, and what needs ROS: no library.
NOT_IN_API = {"benchmarks", "commands", "reproduction", "ros", "validation"}
COMPILED = ("_pbd", "_distance", "_control")
FOLDERS = {
    "pbd": "Position-based dynamics",
    "distance": "Distances",
    "control": "Control",
}

_LINK = re.compile(r"(?P<before>!?\[[^\]]*\]\(|src=\")(?P<target>[^)\"#\s]+)(?P<rest>[^)\"]*[)\"])")


class Stage:
    """A folder of pages made from those of a checkout."""

    def __init__(self, checkout: Path, doxygen: Path, folder: Path):
        self._checkout, self._doxygen, self._folder = checkout, doxygen, folder
        self._pages = dict(PAGES)
        for page in sorted((checkout / "docs").rglob("*.md")):
            name = page.relative_to(checkout).as_posix()
            if not name.startswith("docs/site/"):
                self._pages[name] = name[len("docs/") :]

    def make(self) -> None:
        """Write all pages and their pictures anew."""
        shutil.rmtree(self._folder, ignore_errors=True)
        shutil.copytree(self._checkout / "docs" / "site", self._folder)
        for origin, page in self._pages.items():
            text = (self._checkout / origin).read_text(encoding="utf-8")
            if page.endswith(".md"):
                text = _LINK.sub(partial(self._moved, origin, page), text)
            self._write(page, text)
        if not any(page.startswith("barriers/") for page in self._pages.values()):
            self._drop_barriers()
        self._write_python_pages()
        self._write_cpp_pages()

    def _drop_barriers(self) -> None:
        """Sphinx warns of a table of contents without pages."""
        index = self._folder / "index.md"
        text = index.read_text(encoding="utf-8")
        index.write_text(
            re.sub(r"```{toctree}\n:caption: Barriers\n.*?```\n\n", "", text, flags=re.S)
        )

    def _moved(self, origin: str, page: str, link) -> str:
        """A link of a page as it holds for the page's place in the stage."""
        target = link["target"]
        if ":" in target:
            return link[0]
        wanted = os.path.normpath(os.path.join(os.path.dirname(origin), target))
        if not (self._checkout / wanted).is_file():
            if not (self._checkout / wanted).exists():
                raise SystemExit(f"stage: {origin}: there is no {wanted}, which it links to")
            return re.sub(r"^\[(.*)\]\($", r"\1", link["before"])  # a folder: its name alone
        place = self._pages.get(wanted)
        if place is None:
            place = wanted[len("docs/") :] if wanted.startswith("docs/") else f"files/{wanted}"
            copy = self._folder / place
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self._checkout / wanted, copy)
        moved = os.path.relpath(place, os.path.dirname(page) or ".")
        return link["before"] + moved + link["rest"]

    def _write_python_pages(self) -> None:
        source = self._checkout / "src" / PACKAGE
        rooms = [source, *sorted(path.parent for path in source.glob("*/__init__.py"))]
        listed = []
        for room in rooms:
            modules = [path for path in sorted(room.glob("*.py")) if path.stat().st_size > 0]
            if room == source:
                modules.remove(room / "__init__.py")
            if modules and room.name not in NOT_IN_API:
                sections = [
                    _automodule(self._module(path), path.name == "__init__.py") for path in modules
                ]
                self._write_api_page(f"api/{room.name}.md", room.name, sections)
                listed.append(room.name)
        compiled = [_automodule(f"{PACKAGE}.{module}") for module in COMPILED]
        self._write_api_page("api/compiled.md", "Compiled modules", compiled)
        self._write(
            "api/python.md", _contents("Python API", PYTHON_INTRODUCTION, [*listed, "compiled"])
        )

    def _module(self, path: Path) -> str:
        parts = path.relative_to(self._checkout / "src").with_suffix("").parts
        return ".".join(part for part in parts if part != "__init__")

    def _write_cpp_pages(self) -> None:
        names = []
        for folder, title in FOLDERS.items():
            text = cpp_page(title, f"{PACKAGE}/{folder}", self._doxygen)
            self._write(f"api/cpp_{folder}.rst", text)
            names.append(f"cpp_{folder}")
        self._write("api/cpp.md", _contents("C++ API", CPP_INTRODUCTION, names))

    def _write_api_page(self, page: str, title: str, sections) -> None:
        self._write(page, f"# {title}\n\n" + "\n".join(sections))

    def _write(self, page: str, text: str) -> None:
        path = self._folder / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


PYTHON_INTRODUCTION = """The modules that are of use as a library. None of them needs ROS.
[The architecture](../architecture.md) explains which module does what."""
CPP_INTRODUCTION = """Three libraries without ROS: `deformable_manipulation_pbd`,
`deformable_manipulation_distance` and `deformable_manipulation_control`.
[The architecture](../architecture.md) explains which header does what."""


def _contents(title: str, introduction: str, pages) -> str:
    entries = "\n".join(pages)
    return f"# {title}\n\n{introduction}\n\n```{{toctree}}\n:maxdepth: 2\n\n{entries}\n```\n"


def _automodule(module: str, repeats: bool = False) -> str:
    """A section of a module; one that repeats the names of others is no target of references."""
    title = module.split(".", 1)[-1]
    options = "   :no-index:\n" if repeats else ""
    return f"## {title}\n\n```{{eval-rst}}\n.. automodule:: {module}\n{options}```\n"


if __name__ == "__main__":
    Stage(*map(Path, sys.argv[1:])).make()
