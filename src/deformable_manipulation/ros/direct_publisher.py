"""Publishes without threads."""

import select
import warnings

import rospy


class DirectPublisher(rospy.Publisher):
    """Sends small messages in the caller's thread, and waits for no subscriber.

    rospy hands each message to a thread for each subscriber, which costs every command
    some 0.1 ms more, or, without a queue, waits for a subscriber that stands still. Here one whose
    connection is nearly full is left out until it reads again; before that the connection holds
    thousands of messages of a few hundred bytes.

    Args:
        topic, message_class: as for rospy.Publisher.
        latch: keep the last message for subscribers that come late.
    """

    def __init__(self, topic, message_class, latch=False):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SyntaxWarning)  # that it has no queue
            super().__init__(topic, message_class, tcp_nodelay=True, latch=latch)

    def publish(self, message):
        """Publish a message; safe for several threads."""
        connections = self.impl.connections  # rospy replaces the list where it changes
        if all(map(_has_room, connections)):
            super().publish(message)
            return
        self.impl.acquire()
        try:
            for connection in filter(_has_room, connections):
                self.impl.publish(message, connection_override=connection)
        finally:
            self.impl.release()


def _has_room(connection):
    """Whether a small message can be written at once: a third of the connection's buffer is free.

    A connection that has just been closed is left to rospy.
    """
    try:
        return bool(select.select([], [connection], [], 0.0)[1])
    except (OSError, TypeError, ValueError):
        return True
