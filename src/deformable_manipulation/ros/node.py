"""What the package's rospy nodes have in common."""

import re
import sys
import threading
import time

import numpy as np
import rospy

from deformable_manipulation.scenario import ScenarioError, scenario_from_mapping

# A state of a large fabric with its copies has some hundred kilobytes. rospy reads a socket into
# a buffer of this size; a smaller one makes it fall behind.
BUFFER_SIZE = 1 << 22  # bytes

# Messages kept for a subscriber that is slow for a moment: a recorder must not lose any.
QUEUE_SIZE = 100


def start(name):
    """Start a node and read the checked scenario.

    Leaves the process with a message that says what to do if numpy or the scenario is unusable.

    Returns:
        :class:`~deformable_manipulation.scenario.spec.Scenario`
    """
    rospy.init_node(name)
    _require_numpy()
    if not rospy.has_param("scenario"):
        refuse(
            f"Parameter {rospy.resolve_name('scenario')} is missing: start with "
            "launch/run.launch, which checks the scenario file and sets the parameter."
        )
    try:
        return scenario_from_mapping(rospy.get_param("scenario"), ".", files_are_read=True)
    except ScenarioError as error:
        refuse(f"Parameter {rospy.resolve_name('scenario')} is not a correct scenario:\n{error}")


def refuse(reason):
    """Leave the process because it cannot work."""
    rospy.logfatal(reason)
    sys.exit(1)


class Warnings:
    """Warnings to the log, each at most once per period [s] of real time.

    Texts that differ only in their numbers count as the same.
    """

    def __init__(self, period=5.0, clock=time.monotonic):
        self._period = period
        self._clock = clock
        self._last = {}

    def warn(self, text):
        now = self._clock()
        kind = re.sub(r"[\d.]+", "", text)
        if kind not in self._last or now - self._last[kind] > self._period:
            self._last[kind] = now
            rospy.logwarn(text)


def _require_numpy():
    """rospy.numpy_msg publishes arrays with a method that numpy 2.3 no longer has."""
    if not hasattr(np.ndarray, "tostring"):
        refuse(
            f"numpy {np.__version__} does not work with this rospy: install the versions in "
            "scripts/pip-requirements.txt (scripts/setup does)."
        )


def subscribe(topic, message_class, callback, queue_size=1, buffer_size=BUFFER_SIZE):
    """Subscribe to a topic without delay: to its newest message, or to more of them."""
    return rospy.Subscriber(
        topic,
        message_class,
        _until_shutdown(callback),
        queue_size=queue_size,
        buff_size=buffer_size,
        tcp_nodelay=True,
    )


def await_subscribers(publisher):
    """Wait until a publisher has as many subscribers as the parameter ~output_subscribers says.

    A lock-step run starts when all nodes have subscribed to the state; a node that waits before
    it does keeps its first messages from being lost to a recorder.
    """
    wanted = rospy.get_param("~output_subscribers", 0)
    stopped = threading.Event()
    rospy.on_shutdown(stopped.set)
    while publisher.get_num_connections() < wanted and not stopped.wait(0.01):
        connected = publisher.get_num_connections()
        rospy.loginfo_throttle(
            5.0, f"Waiting for subscribers of {publisher.name}: {connected} of {wanted} are there."
        )


def every(period, callback):
    """Call back every period [s] of real time, whatever the ROS clock does, until shutdown."""
    stopped = threading.Event()
    rospy.on_shutdown(stopped.set)
    call = _until_shutdown(callback)

    def loop():
        while not stopped.wait(period):
            call()

    threading.Thread(target=loop, daemon=True).start()


def _until_shutdown(callback):
    """The callback, which may find at the very end that the publishers are closed already."""

    def call(*arguments):
        try:
            callback(*arguments)
        except rospy.ROSException:
            if not rospy.core.is_shutdown_requested():
                raise

    return call
