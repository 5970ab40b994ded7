"""What a process has taken of the machine so far."""

import os
from dataclasses import dataclass
from pathlib import Path

_TICKS = os.sysconf("SC_CLK_TCK")  # per second


@dataclass(frozen=True)
class Usage:
    """Processor time since the process began, and memory at the moment."""

    processor: float  # s, of all its threads
    memory: int  # bytes; what is shared counts in parts (PSS)


def usage_of(pid: int, proc: Path = Path("/proc")) -> Usage:
    """The :class:`Usage` of a process. Raises OSError: there is none, or it is another user's."""
    folder = proc / str(pid)
    # The name, in parentheses, may have blanks in it.
    fields = (folder / "stat").read_text().rpartition(")")[2].split()
    ticks = int(fields[11]) + int(fields[12])
    rollup = (folder / "smaps_rollup").read_text()
    kilobytes = int(rollup.partition("\nPss:")[2].split()[0])
    return Usage(ticks / _TICKS, 1024 * kilobytes)
