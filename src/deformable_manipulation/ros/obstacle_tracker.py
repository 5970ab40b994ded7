"""Poses of a run's moving obstacles: from the scenario's paths, from topics and from tf."""

import rospy
from geometry_msgs.msg import PoseStamped

from deformable_manipulation.cycles.input_watch import find_age_fault
from deformable_manipulation.motion.obstacle_motion import MovingObstacles, moving_obstacles
from deformable_manipulation.motion.pose_track import PoseTrack
from deformable_manipulation.ros import node
from deformable_manipulation.ros.transforms import listening_buffer
from deformable_manipulation.scenario.spec import FrameMotion, TopicMotion


class ObstacleTracker:
    """Moves the obstacles of a minimum distance to where they are.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario):
        self._moving = MovingObstacles(scenario)
        self._cycle_time = scenario.cycle_time
        indices = moving_obstacles(scenario)
        #: Names of the moving obstacles.
        self.names = [scenario.obstacles[index].name for index in indices]
        self._sources = {}
        buffer = None
        for index in indices:
            motion = scenario.obstacles[index].motion
            if isinstance(motion, TopicMotion):
                self._sources[index] = _TopicSource(scenario, index)
            elif isinstance(motion, FrameMotion):
                buffer = buffer or listening_buffer()
                self._sources[index] = _FrameSource(scenario, index, buffer)

    def move(self, distance, state):
        """Move the obstacles to where they are at a state.

        Returns:
            Which of them are lost, as a clause; empty where all are known.
        """
        self._moving.move(distance, state.cycle * self._cycle_time)
        now = state.header.stamp.to_sec()
        faults = []
        for index, source in self._sources.items():
            fault = source.fault(now)
            if fault:
                faults.append(fault)
            else:
                self._moving.put(distance, index, source.track.at(now))
        return ", ".join(faults)

    def poses(self):
        """Where the moving obstacles were put last, (K, 7)."""
        return self._moving.poses()


class _Source:
    """Where the poses of an obstacle come from; ``origin`` says it in words."""

    def __init__(self, scenario, index, origin):
        self._obstacle = scenario.obstacles[index]
        self._origin = origin
        self._timeout = scenario.controller.timeout
        self._frame = scenario.frame
        self._warnings = node.Warnings()
        # Nothing acts on poses of more than twice the controller's rate; noise would.
        self.track = PoseTrack(self._timeout, 0.5 * scenario.cycle_time)

    def fault(self, now):
        """Why there is no pose at a time [s], as a clause; empty if there is one."""
        fault = self.track.fault(now)
        return fault and f"obstacle '{self._obstacle.name}' is lost: {fault} {self._origin}"

    def _take(self, stamp, position, orientation):
        age = (rospy.Time.now() - stamp).to_sec()
        dropped = find_age_fault(age, self._timeout) or self.track.update(
            stamp.to_sec(), _numbers(position, "xyz"), _numbers(orientation, "xyzw")
        )
        if dropped:
            self._drop(dropped)

    def _drop(self, reason):
        self._warnings.warn(
            f"Obstacle '{self._obstacle.name}' ignores a pose {self._origin}: {reason}"
        )


class _TopicSource(_Source):
    """Poses in the fixed frame from a topic."""

    def __init__(self, scenario, index):
        topic = rospy.resolve_name(scenario.obstacles[index].motion.topic)
        super().__init__(scenario, index, f"on {topic}")
        node.subscribe(topic, PoseStamped, self._on_pose)

    def _on_pose(self, message):
        if message.header.frame_id != self._frame:
            self._drop(f"it is in frame '{message.header.frame_id}', not in '{self._frame}'")
        else:
            self._take(message.header.stamp, message.pose.position, message.pose.orientation)


class _FrameSource(_Source):
    """Poses of a tf frame, the newest one whenever it is asked for."""

    def __init__(self, scenario, index, buffer):
        self._child = scenario.obstacles[index].motion.frame
        super().__init__(scenario, index, f"of tf frame '{self._child}' in '{scenario.frame}'")
        self._buffer = buffer
        self._newest = None  # stamp

    def fault(self, now):
        self._look_up()
        return super().fault(now)

    def _look_up(self):
        import tf2_ros

        try:
            found = self._buffer.lookup_transform(self._frame, self._child, rospy.Time(0))
        except tf2_ros.TransformException:
            return  # not there, which the track's age tells
        stamp, pose = found.header.stamp, found.transform
        if stamp == self._newest:
            return
        self._newest = stamp
        if stamp.is_zero():  # of a static transform
            self.track.hold(_numbers(pose.translation, "xyz"), _numbers(pose.rotation, "xyzw"))
        else:
            self._take(stamp, pose.translation, pose.rotation)


def _numbers(message, fields):
    return [getattr(message, field) for field in fields]
