"""Notices when messages stop coming, or come late."""

import time


class InputWatch:
    """Ages of a node's inputs by the machine's own clock, which nobody sets back.

    Args:
        names: of the inputs.
        timeout: age [s] at which an input counts as lost.
        clock: seconds, never decreasing.
    """

    def __init__(self, names, timeout, clock=time.monotonic):
        self._timeout = timeout
        self._clock = clock
        self._last = dict.fromkeys(names)

    def received(self, name):
        """A message of an input has come."""
        self._last[name] = self._clock()

    def fault(self):
        """A clause that names the inputs that are lost; empty if there is none."""
        now = self._clock()
        lost = []
        for name, last in self._last.items():
            if last is None:
                lost.append(f"no {name} yet")
            elif now - last > self._timeout:
                lost.append(f"no {name} for {now - last:.1f} s")
        return ", ".join(lost)


def find_age_fault(age, timeout):
    """A clause that says why a message of this age by its stamp [s] is not used; empty if it is."""
    if age > timeout:
        return f"its stamp is {age:.1f} s old"
    if age < -timeout:
        return f"its stamp is {-age:.1f} s in the future; synchronise the clocks"
    return ""
