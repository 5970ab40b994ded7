"""Counts the cycles that a node answers, and those that it does not answer in time."""


class CycleCounter:
    """Answers to states, those given late, and states that were never seen.

    Args:
        period: cycle time [s]; an answer later than this after its state is an overrun.
    """

    def __init__(self, period):
        self._period = period
        self._newest = None
        self.answered = 0  # states
        self.overruns = 0  # answers that came later than a cycle after their state
        self.skipped = 0  # states that were missed between two that were seen

    def count(self, state, age=0.0):
        """A state has been answered when it was so old [s].

        Returns:
            whether it was an overrun, or states before it were skipped.
        """
        late = age > self._period
        gap = self._gap(state)
        self._newest = state
        self.answered += 1
        self.overruns += late
        self.skipped += gap
        return late or gap > 0

    @property
    def summary(self):
        """The counts in words, which ``benchmark loop`` reads."""
        skipped = f"{self.skipped} {'state' if self.skipped == 1 else 'states'} skipped"
        return f"Overruns: {self.overruns} of {self.answered} cycles, {skipped}."

    def _gap(self, state):
        newest = self._newest
        if newest is None or newest.reset_count != state.reset_count:
            return 0
        return max(0, state.cycle - newest.cycle - 1)
