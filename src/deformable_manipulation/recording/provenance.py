"""What made a run: the version of this package and the machine."""

import os
import platform
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Optional

PACKAGE = "deformable_manipulation"


def package_version(start: Path = Path(__file__)) -> Optional[str]:
    """The version in the package's ``package.xml``; None if that is not found.

    Looks upwards from ``start``, which finds it in a source tree and, under ``share``, in an
    install space.
    """
    for folder in start.resolve().parents:
        for manifest in (folder / "package.xml", folder / "share" / PACKAGE / "package.xml"):
            version = _manifest_version(manifest)
            if version is not None:
                return version
    return None


def machine() -> dict:
    """Processor, number of its cores that this process may use, and Python version."""
    return {
        "processor": _processor(Path("/proc/cpuinfo")),
        "cores": len(os.sched_getaffinity(0)),
        "python": platform.python_version(),
    }


def _manifest_version(manifest: Path) -> Optional[str]:
    try:
        root = ElementTree.parse(str(manifest)).getroot()
    except (OSError, ElementTree.ParseError):
        return None
    if (root.findtext("name") or "").strip() != PACKAGE:
        return None
    return (root.findtext("version") or "").strip() or None


def _processor(cpuinfo: Path) -> str:
    """The processor's model; arm64 kernels do not name it, the architecture must do there."""
    try:
        lines = cpuinfo.read_text().splitlines()
    except OSError:
        lines = []
    for line in lines:
        key, _, value = line.partition(":")
        if key.strip() == "model name" and value.strip():
            return value.strip()
    return platform.processor() or platform.machine()
