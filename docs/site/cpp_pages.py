"""Pages of the C++ API, header by header, from what Doxygen found."""

from pathlib import Path
from typing import Dict, List
from xml.etree import ElementTree

_COMPOUNDS = {"class": "doxygenclass", "struct": "doxygenstruct"}
_MEMBERS = {
    "enum": "doxygenenum",
    "function": "doxygenfunction",
    "typedef": "doxygentypedef",
    "variable": "doxygenvariable",
}


def cpp_page(title: str, folder: str, doxygen: Path) -> str:
    """The page (reStructuredText) of the headers of a folder.

    Breathe's own directive for a header mixes up headers of the same name.

    Args:
        title: of the page.
        folder: as it is included, "deformable_manipulation/pbd".
        doxygen: folder of Doxygen's XML.
    """
    headers: Dict[str, List[str]] = {}
    for path in sorted(doxygen.glob("*.xml")):
        compound = ElementTree.parse(path).getroot().find("compounddef")
        if compound is None:
            continue
        kind, name = compound.get("kind", ""), compound.findtext("compoundname", "")
        if kind in _COMPOUNDS and compound.get("prot") == "public":
            _list(headers, compound, f".. {_COMPOUNDS[kind]}:: {name}\n   :members:\n")
        elif kind == "namespace":
            for member in compound.iter("memberdef"):
                directive = _MEMBERS.get(member.get("kind", ""))
                if directive:
                    _list(headers, member, f".. {directive}:: {name}::{_signature(member)}\n")
    sections = [_heading(title, "=")]
    for header in sorted(headers):
        if header.rpartition("/")[0].endswith(folder):
            sections += [_heading(header.rpartition("/")[2], "-"), *headers[header]]
    return "\n".join(sections)


def _list(headers: Dict[str, List[str]], element, directive: str) -> None:
    headers.setdefault(element.find("location").get("file"), []).append(directive)


def _signature(member) -> str:
    """The name, and for functions what tells them from others of the same name."""
    arguments = member.findtext("argsstring", "") if member.get("kind") == "function" else ""
    return member.findtext("name", "") + arguments


def _heading(title: str, line: str) -> str:
    return f"{title}\n{line * len(title)}\n"
