"""XML of mesh files."""

import re
from typing import Iterator, List, Optional
from xml.etree import ElementTree

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.mesh_formats.numbers_in_text import shown

Element = ElementTree.Element
_NAMESPACE = re.compile(r"^\{[^}]*\}")


def parsed(data: bytes) -> Element:
    """The root of an XML file, names without their namespaces.

    Raises:
        FormatError: with the line; also where the file declares entities, which can blow it up.
    """
    if b"<!ENTITY" in data:
        raise FormatError("it declares XML entities, which no mesh needs; remove them")
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise FormatError("it is no XML, or broken: {}".format(error)) from None
    except (ValueError, LookupError) as error:  # an encoding that is not known
        raise FormatError("it is no XML that can be read: {}".format(error)) from None
    for element in root.iter():
        element.tag = _NAMESPACE.sub("", str(element.tag))
        for key in list(element.attrib):
            element.attrib[_NAMESPACE.sub("", key)] = element.attrib.pop(key)
    return root


def children(element: Optional[Element], *names: str) -> Iterator[Element]:
    """The children of some names, in their order."""
    return (child for child in (() if element is None else element) if child.tag in names)


def text_numbers(element: Element, kind=float) -> np.ndarray:
    """The numbers (N,) between an element's tags. Raises FormatError."""
    return listed_numbers(element.text or "", element.tag, kind)


def listed_numbers(text: str, name: str, kind=float) -> np.ndarray:
    """The numbers (N,) of a text. Raises FormatError, with the name of what holds them."""
    words: List[str] = text.split()
    try:
        return np.array(words, dtype=kind)
    except (ValueError, OverflowError):
        raise FormatError("<{}> holds {}, not numbers".format(name, shown(text))) from None
