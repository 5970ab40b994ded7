"""Brings messages of the same cycle together."""

import threading
from collections import deque

_KEPT = 100  # messages of each kind that wait for the other


class CyclePairing:
    """Pairs the states and distances of one cycle, in whatever order they arrive.

    Messages wait for their counterpart, so that distances some cycles behind the states still find
    theirs. Pairs only advance: a message that comes later than a newer one of its kind, or belongs
    to a cycle before the last pair, is dropped. Safe for callbacks in different threads.

    Args:
        callback: called with (state, distances) as soon as both of a cycle are there.
    """

    def __init__(self, callback):
        self._callback = callback
        self._lock = threading.Lock()
        self._states = _Waiting()
        self._distances = _Waiting()

    @property
    def newest_state(self):
        """The newest state, or None."""
        return self._states.newest

    def state(self, message):
        """Take in a state."""
        self._take_in(message, self._states)

    def distances(self, message):
        """Take in distances."""
        self._take_in(message, self._distances)

    def _take_in(self, message, waiting):
        with self._lock:
            if not waiting.add(message):
                return
            key = _match(message)
            if self._states.has(key) and self._distances.has(key):
                self._callback(self._states.pop(key), self._distances.pop(key))


class Advance:
    """Tells the messages of one kind that are newer than all before."""

    def __init__(self):
        self.newest = None

    def take(self, message):
        """Whether a message is newer than all before."""
        newer = self.newest is None or _is_newer(message, self.newest)
        if newer:
            self.newest = message
        return newer


class _Waiting(Advance):
    """Messages of one kind that wait for their counterpart, the oldest first."""

    def __init__(self):
        super().__init__()
        self._messages = deque(maxlen=_KEPT)

    def add(self, message):
        """Keep a message if it is newer than all before; whether it is."""
        newer = self.take(message)
        if newer:
            self._messages.append(message)
        return newer

    def has(self, key):
        return any(_match(message) == key for message in self._messages)

    def pop(self, key):
        """The message of this key; it and all older ones wait no longer."""
        while True:
            message = self._messages.popleft()
            if _match(message) == key:
                return message


def _key(message):
    return message.reset_count, message.cycle


def _match(message):
    # With the stamp: after a new start of the simulator the cycles come again.
    return _key(message), message.header.stamp


def _is_newer(message, known):
    # A simulator that was started again begins with cycle 0: there the stamp tells. Where the
    # clock was set back, the cycle does.
    return message.header.stamp > known.header.stamp or _key(message) > _key(known)
