"""What a measurement was made on."""

import os
import platform
import re
from importlib import metadata
from pathlib import Path
from typing import Dict, List, Sequence

from deformable_manipulation.recording.provenance import machine, package_version

# Those that the simulation is compiled for, by the name that the kernel gives the flag.
INSTRUCTION_SETS = ("avx2", "fma", "avx512f", "avx512dq", "asimd")
INSTRUCTION_SET_VARIABLE = "DEFORMABLE_MANIPULATION_INSTRUCTION_SET"
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
        "chosen instruction set": os.environ.get(INSTRUCTION_SET_VARIABLE, "the widest there is"),
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
    from deformable_manipulation import _pbd

    signature = re.search(
        rb"GCC: \([^)]*\) [\d.]+|clang version [\d.]+", Path(_pbd.__file__).read_bytes()
    )
    return signature.group().decode() if signature else "unknown"
