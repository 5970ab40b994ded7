"""The outcome of a controller's cycle."""

from enum import IntEnum


class Status(IntEnum):
    """Outcome of one cycle; the numbers are those of ControllerState.msg."""

    NOMINAL = 0
    CONSTRAINED = 1
    RELAXED = 2
    FAILED = 3
    WAITING = 4
    DISABLED = 5
    UNSAFE_FILTER_OFF = 6

    @property
    def sentence(self):
        """The status in words."""
        return _SENTENCES[self]

    @property
    def follows(self):
        """Whether the assistant follows the leader, as far as its constraints allow."""
        return self not in (Status.FAILED, Status.WAITING, Status.DISABLED)


class DetourState(IntEnum):
    """Whether an assistant goes another way than straight to its place."""

    NONE = 0
    SEARCHING = 1
    FOLLOWING = 2
    NO_WAY = 3

    @property
    def sentence(self):
        """The state in words; empty for NONE."""
        return _DETOURS[self]


_DETOURS = {
    DetourState.NONE: "",
    DetourState.SEARCHING: "It is held off its place and looks for a way around.",
    DetourState.FOLLOWING: "It takes a way around to its place.",
    DetourState.NO_WAY: "It is held off its place, and no way around within the limits was found.",
}

_SENTENCES = {
    Status.NOMINAL: "Follows the leader: no constraint changes the nominal velocity.",
    Status.CONSTRAINED: "Departs from the nominal velocity so that all constraints hold.",
    Status.RELAXED: "Not all constraints can hold; relaxed in their priority.",
    Status.FAILED: "The quadratic program has no valid solution: zero velocity.",
    Status.WAITING: "Waits for valid input, at rest or slowing down to it.",
    Status.DISABLED: "Switched off, at rest or slowing down to it.",
    Status.UNSAFE_FILTER_OFF: "UNSAFE, the safety filter is off: nominal velocity within limits.",
}
