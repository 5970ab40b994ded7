"""What a measurement was made on."""

import ctypes
import math
import os
import platform
import re
from importlib import metadata
from pathlib import Path
from typing import Dict, List, Sequence

from deformable_manipulation import _pbd
from deformable_manipulation.recording.provenance import machine, package_version

# Those that the simulation is compiled for, by the name that the kernel gives the flag.
INSTRUCTION_SETS = ("avx2", "fma", "avx512f", "avx512dq", "asimd")
BUSY = 0.5  # processes that want to run beside the measurement, from which on it is disturbed


def describe_machine(libraries: Sequence[str] = ()) -> Dict[str, str]:
    """Processor, load, system, compiler and versions, by what they are called in a table.

    libraries: names of Python packages whose versions matter.
    """
    here = machine()
    described = {
        "processor": here["processor"],
        "cores": str(here["cores"]),
        "instruction sets": " ".join(_instruction_sets(Path("/proc/cpuinfo"))) or "unknown",
        "chosen instruction set": _pbd.instruction_set(),
        "load before": "{:.2f}".format(load()),
        "system": "{}, {} {}".format(_distribution(), platform.system(), platform.release()),
        "compiler": _compiler(),
        "Python": here["python"],
        "deformable_manipulation": package_version() or "unknown",
    }
    described.update({name: metadata.version(name) for name in libraries})
    return described


def load() -> float:
    """Mean number of processes that wanted to run during the last minute."""
    return os.getloadavg()[0]


def load_warning(value: float) -> str:
    """A sentence where others were running, else nothing."""
    if value < BUSY:
        return ""
    return (
        f"the load of this machine is {value:.2f}: something else is running, and the times are "
        "longer than they would be; compare minima, or measure again"
    )


class _Allocations(ctypes.Structure):
    """mallinfo2 of the GNU C library, 2.33 or later: what malloc has handed out, and much else."""

    _fields_ = [
        (name, ctypes.c_size_t)
        for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd")
        + ("usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")
    ]


def allocated() -> float:
    """Bytes that C and C++ have allocated and not freed; NaN where the system cannot tell."""
    try:
        query = ctypes.CDLL(None).mallinfo2
    except AttributeError:
        return math.nan
    query.restype = _Allocations
    allocations = query()
    return float(allocations.uordblks + allocations.hblkhd)


def _instruction_sets(cpuinfo: Path) -> List[str]:
    try:
        lines = cpuinfo.read_text().splitlines()
    except OSError:
        return []
    for line in lines:
        key, _, value = line.partition(":")
        if key.strip() in ("flags", "Features"):
            flags = value.split()
            return [name for name in INSTRUCTION_SETS if name in flags]
    return []


def _distribution() -> str:
    try:
        text = Path("/etc/os-release").read_text()
    except OSError:
        return platform.platform()
    found = re.search(r'^PRETTY_NAME="?([^"\n]*)', text, re.MULTILINE)
    return found.group(1) if found else platform.platform()


def _compiler() -> str:
    """The compiler of the simulation, as it signed what it compiled."""
    signature = re.search(
        rb"GCC: \([^)]*\) [\d.]+|clang version [\d.]+", Path(_pbd.__file__).read_bytes()
    )
    return signature.group().decode() if signature else "unknown"
