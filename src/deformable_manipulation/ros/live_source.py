"""The data of one live obstacle from its topic."""

import threading
import time

import rospy
from sensor_msgs.msg import PointCloud2

from deformable_manipulation.cloud_formats.point_cloud2 import columns
from deformable_manipulation.cycles.input_watch import find_age_fault
from deformable_manipulation.ros import node
from deformable_manipulation.ros.point_clouds import to_point_cloud
from deformable_manipulation.seeing.live_map import LiveMap, is_later
from deformable_manipulation.seeing.sight import lost

_BUFFER_SIZE = 1 << 26  # bytes; four million points
_POLLING_PERIOD = 0.005  # s of real time, for transforms
_TOLERANCE = 1e-6  # s, of stamps
_LONGEST_WAIT = 0.1  # s of real time, for the state of a stamp


class LiveSource:
    """Takes in the newest data whenever they come, in a thread of its own.

    One message is worked on and one waits, the newest: more are never kept. What was known before
    stays until the new data are ready to be searched.

    Args:
        scenario: the checked scenario.
        index: of the obstacle.
        history: StateHistory of the carried object.
        transforms: Transforms.
        lockstep: data of a state are taken in once that state has been answered.
        shows: whether it publishes the points that are used.
    """

    def __init__(self, scenario, index, history, transforms, lockstep, shows):
        self._map = LiveMap(scenario, index)
        self._frame = scenario.frame
        self._history, self._transforms, self._lockstep = history, transforms, lockstep
        spec = scenario.obstacles[index]
        self._topic = rospy.resolve_name(spec.topic)
        self._warnings = node.Warnings()
        self._arrival = threading.Condition()
        self._waiting = None  # message
        self._done = self._answered = float("-inf")  # s, stamps
        self._copies = None  # (C, P, 3) m, of the newest state
        self._senders = {}  # when each has sent last [s] of time.monotonic()
        self._used = None
        if shows:
            self._used = rospy.Publisher(
                f"{self._topic}/used",
                PointCloud2,
                subscriber_listener=_Late(self._used_points),
                queue_size=1,
            )
        node.subscribe(self._topic, PointCloud2, self._on_message, buffer_size=_BUFFER_SIZE)
        threading.Thread(target=self._work, daemon=True).start()

    @property
    def seen(self):
        """What is known (:class:`~..seeing.live_map.Seen`), or None."""
        return self._map.seen

    def fault(self, now):
        """Why it is not known at a time [s], as a clause; empty if it is."""
        recent = time.monotonic() - self._map.spec.timeout
        senders = sorted(each for each, last in list(self._senders.items()) if last >= recent)
        if len(senders) > 1:
            return lost(self._map, f"{' and '.join(senders)} both send", f"on {self._topic}")
        return lost(self._map, self._map.fault(now), f"on {self._topic}")

    def reset(self):
        """Go back to the start."""
        with self._arrival:
            self._map.forget()
            self._done = float("-inf")

    def await_data(self, stamp):
        """Wait until the data of a stamp [s] have been taken in or dropped."""
        with self._arrival:
            while self._done < stamp - _TOLERANCE and not rospy.is_shutdown():
                self._arrival.wait(0.1)

    def answered(self, stamp, copies):
        """Note that a state of a stamp [s] with copies (C, P, 3) [m] has its distances."""
        with self._arrival:
            self._answered, self._copies = stamp, copies
            self._arrival.notify_all()

    def _on_message(self, message):
        with self._arrival:
            self._senders = {
                sender: last
                for sender, last in self._senders.items()
                if last >= time.monotonic() - self._map.spec.timeout
            }
            self._senders[message._connection_header["callerid"]] = time.monotonic()
            self._waiting = message
            self._arrival.notify_all()

    def _work(self):
        while not rospy.is_shutdown():
            with self._arrival:
                if self._waiting is None and not self._arrival.wait(0.1):
                    continue
                message, self._waiting = self._waiting, None
            if message is None:
                continue
            try:
                self._use(message)
            except ValueError as error:
                self._warnings.warn(
                    f"Obstacle '{self._map.spec.name}' ignores data on {self._topic}: {error}"
                )
            with self._arrival:
                self._done = message.header.stamp.to_sec()
                self._arrival.notify_all()

    def _use(self, message):
        stamp = message.header.stamp.to_sec()
        self._check_time(message.header.stamp)
        values = columns(message, self._map.spec.fields)
        if message.height > 1:  # an image
            values = values.reshape(message.height, message.width, -1)
        pose = self._transforms.await_pose(message.header, self._map.spec.timeout)
        state = self._state_at(stamp)
        copies = None if self._lockstep else self._copies
        self._map.take(stamp, values, pose, state, self._transforms.find, copies)
        if self._used is not None and self._used.get_num_connections():
            self._used.publish(self._used_points())

    def _used_points(self):
        """The newest points that are not left out, or None."""
        seen = self._map.seen
        return seen and to_point_cloud(seen.places[-1], seen.time, self._frame)

    def _check_time(self, stamp):
        """Raises ValueError: data are too old to be used, or not newer than what is known."""
        if stamp.is_zero():
            raise ValueError("they have no stamp")
        timeout = self._map.spec.timeout
        fault = find_age_fault((rospy.Time.now() - stamp).to_sec(), timeout)
        if fault and not self._lockstep:
            raise ValueError(fault)
        before = self._map.seen.time if self._map.seen else float("-inf")
        if not is_later(stamp.to_sec(), before, timeout):
            raise ValueError("they are not newer than those before")

    def _state_at(self, stamp):
        """The carried object at a stamp [s]."""
        give_up = time.monotonic() + _LONGEST_WAIT
        with self._arrival:
            while not rospy.is_shutdown():
                late = time.monotonic() > give_up and not self._lockstep
                if self._answered >= stamp - _TOLERANCE or late:
                    break
                self._arrival.wait(_POLLING_PERIOD)
        state = self._history.at(stamp)
        if state is None:
            raise ValueError("there is no state of the object yet, near which points are left out")
        return state


class _Late(rospy.SubscribeListener):
    """Gives whoever subscribes the newest message at once.

    Args:
        newest: function without arguments that gives it, or None.
    """

    def __init__(self, newest):
        super().__init__()
        self._newest = newest

    def peer_subscribe(self, _topic, _publish, publish_to_peer):
        message = self._newest()
        if message is not None:
            publish_to_peer(message)
