"""Brings messages of the same cycle together."""

import threading


class CyclePairing:
    """Pairs the states and distances of one cycle, in whatever order they arrive.

    Only the newest of each is kept: an older message that comes late is dropped. Safe for
    callbacks in different threads.

    Args:
        callback: called with (state, distances) as soon as both of a cycle are there.
    """

    def __init__(self, callback):
        self._callback = callback
        self._lock = threading.Lock()
        self._state = None
        self._distances = None

    @property
    def newest_state(self):
        """The newest state, or None."""
        return self._state

    def state(self, message):
        """Take in a state."""
        with self._lock:
            if _is_newer(message, self._state):
                self._state = message
                self._match()

    def distances(self, message):
        """Take in distances."""
        with self._lock:
            if _is_newer(message, self._distances):
                self._distances = message
                self._match()

    def _match(self):
        state, distances = self._state, self._distances
        if state is not None and distances is not None and _key(state) == _key(distances):
            self._callback(state, distances)


def _key(message):
    return message.reset_count, message.cycle


def _is_newer(message, known):
    # A simulator that was started again begins with cycle 0: there the stamp tells. Where the
    # clock was set back, the cycle does.
    return (
        known is None
        or message.header.stamp > known.header.stamp
        or _key(message) > _key(known)
    )
