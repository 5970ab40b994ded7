"""How long assistants waited for what they need, and for what."""

from typing import Dict, Iterator, Mapping

from deformable_manipulation.control.status import Status

_SHORTEST = 0.1  # s: everybody waits for the first state or image
_FEWEST = 2  # cycles, likewise


class Wait:
    """The waiting of one assistant, cycle by cycle."""

    def __init__(self):
        self.cycles = self.waited = self.longest = self._present = 0
        #: Why it waited at the end of the longest time, as a clause; empty: not known.
        self.reason = ""

    def add(self, status: int, reason: str = "") -> None:
        """Take in the status of the next cycle, and why the assistant waits if it does."""
        self.cycles += 1
        if status != Status.WAITING:
            self._present = 0
            return
        self.waited += 1
        self._present += 1
        if self._present >= self.longest:
            self.longest, self.reason = self._present, reason

    def summary(self, rate: float) -> Dict[str, object]:
        """Times [s] and the reason, for ``summary.json``.

        Args:
            rate: [Hz] of the cycles.
        """
        return {
            "time": self.waited / rate,
            "longest": self.longest / rate,
            "always": 0 < self.cycles == self.waited,
            "reason": self.reason,
        }


def describe_waits(waits: Mapping[str, Mapping], rate: float) -> Iterator[str]:
    """A warning for each assistant that waited for longer than everybody does at the start.

    Args:
        waits: what :meth:`Wait.summary` gives, by the assistants' names.
        rate: [Hz] of the cycles.
    """
    for name, wait in waits.items():
        why = ": {}".format(wait["reason"]) if wait["reason"] else ""
        if wait["always"]:
            yield (
                "WARNING: {} never followed the leader, it waited for all of the {:.1f} s{}".format(
                    name, wait["time"], why
                )
            )
        elif wait["time"] > max(_SHORTEST, (_FEWEST + 0.5) / rate):
            yield "WARNING: {} waited for {:.1f} s in all, for up to {:.1f} s at once{}".format(
                name, wait["time"], wait["longest"], why
            )
