"""The leader, or an obstacle, moved by hand."""

import time

import numpy as np

from deformable_manipulation.motion.bounded_motion import BoundedMotion
from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.motion.leader import LeaderController, LeaderTurning
from deformable_manipulation.scenario import leader_workspace

# RViz repeats that a marker is held four times per second.
DRAG_TIMEOUT = 1.0  # s

PATH, WAITING = "path", "waiting"
DRAGGED, STEERED, RESTING = "dragged", "steered", "resting"


class Hand:
    """What a hand wants: a place to go to, a velocity, or rest.

    A dead man's control: rest where no more comes, for ``DRAG_TIMEOUT`` or ``steer_timeout`` [s].

    Args:
        motion: :class:`~.bounded_motion.BoundedMotion`, which bounds what it gets.
        steer_timeout: [s].
        clock: seconds, never decreasing.
    """

    def __init__(self, motion, steer_timeout, clock=time.monotonic):
        self._motion = motion
        self._steer_timeout = steer_timeout
        self._clock = clock
        self.release()

    def release(self):
        """Rest from now on."""
        self._target = self._wanted = None
        self._deadline = self._clock()

    def drag(self, position):
        """Go to a position (3,) [m] of the fixed frame, or the nearest that is allowed.

        Raises:
            ValueError: it is not three finite numbers; the message says so.
        """
        self._target, self._wanted = _three_finite(position, "position"), None
        self._deadline = self._clock() + DRAG_TIMEOUT

    def steer(self, velocity):
        """Move with a velocity (3,) [m/s] of the fixed frame, as far as the limits allow.

        Raises:
            ValueError: it is not three finite numbers; the message says so.
        """
        self._wanted, self._target = _three_finite(velocity, "velocity"), None
        self._deadline = self._clock() + self._steer_timeout

    @property
    def source(self):
        """DRAGGED, STEERED or RESTING."""
        if self._target is None and self._wanted is None or self._clock() > self._deadline:
            return RESTING
        return STEERED if self._target is None else DRAGGED

    def velocity(self, position, velocity):
        """The next velocity (3,) [m/s] of what is at a position (3,) [m] with a velocity (3,)."""
        source = self.source
        if source == DRAGGED:
            return self._motion.towards(self._target, position, velocity)
        wanted = self._wanted if source == STEERED else (0.0, 0.0, 0.0)
        return self._motion.along(wanted, position, velocity)


class SteeredLeader:
    """The leader's velocity: along its path, or by hand from the first time that a hand takes it.

    The path begins with the first state in which all who are to follow do, or which comes after
    :meth:`start`; until then the leader stands still. By hand it stays within ``leader.workspace``,
    ``leader.max_velocity`` and ``leader.max_acceleration``. A :meth:`reset` takes it back to the
    start of its path.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        follows_path: False leaves the path out: at rest until a hand takes it.
        clock: seconds, never decreasing; for the hand's timeouts.
    """

    def __init__(self, scenario, follows_path=True, clock=time.monotonic):
        self._path = LeaderController(scenario)
        self._turning = LeaderTurning(scenario)
        self._follows_path = follows_path
        settings = scenario.leader
        motion = BoundedMotion(
            *leader_workspace(scenario),
            settings.max_velocity,
            settings.max_acceleration,
            scenario.cycle_time,
        )
        self._hand = Hand(motion, scenario.controller.timeout, clock)
        self.reset()

    def reset(self):
        """Back to the start: at rest, on the path again, out of everybody's hands."""
        self._restart_path()
        self._hand.release()
        self._by_hand = not self._follows_path
        self._velocity = [0.0, 0.0, 0.0]
        self._time = None

    def _restart_path(self):
        self._path.reset()
        self._turning.reset()
        self._origin = None  # s, time of the path's begin; None: it has not begun
        self._told_to_start = False

    def start(self):
        """Begin the path with the next state, even if not all assistants follow.

        Raises:
            ValueError: it has begun, or the leader is moved by hand; the message says so.
        """
        if self._by_hand:
            raise ValueError("the leader is moved by hand")
        if self._origin is not None:
            raise ValueError("the leader is on its path already")
        self._told_to_start = True

    def drag(self, position):
        """As :meth:`Hand.drag`."""
        self._hand.drag(position)
        self._by_hand = True

    def steer(self, velocity):
        """As :meth:`Hand.steer`."""
        self._hand.steer(velocity)
        self._by_hand = True

    def release(self):
        """Stop; on the path it stays there."""
        self._hand.release()

    @property
    def source(self):
        """What moves the leader: PATH, DRAGGED, STEERED or RESTING; WAITING before its path."""
        if self._by_hand:
            return self._hand.source
        return WAITING if self._origin is None else PATH

    def update(self, time, position, all_follow=True):
        """Velocity command [m/s] (3,) for one state; see LeaderController.update.

        Args:
            time, position: of the state.
            all_follow: whether all who are to follow the leader do.
        """
        if not self._by_hand:
            return self._along_path(time, position, all_follow)
        if not np.isfinite([time, *position]).all():
            self._velocity = [0.0, 0.0, 0.0]
        elif self._time is None or time > self._time or time < self._time - 1.0:
            self._velocity = self._hand.velocity(position, self._velocity)
            self._time = time
        return np.array(self._velocity)

    def turn(self, time, orientation):
        """Angular velocity command [rad/s] (3,) for a state whose :meth:`update` is done.

        Zero by hand, and before the path begins.

        Args:
            time: of the state [s].
            orientation: of the leader's grip, a quaternion of norm 1.
        """
        if self.source != PATH:
            return np.zeros(3)
        return self._turning.update(time - self._origin, orientation)

    def intent(self):
        """The Intent at the newest state; None by hand and before the path begins."""
        if self.source != PATH or self._time is None:
            return None
        intent = self._path.intent(self._time - self._origin)
        return Intent(intent.times + self._origin, intent.positions)

    def _along_path(self, time, position, all_follow):
        if self._time is not None and time < self._time - 1.0:  # time was set back
            self._restart_path()
        if self._origin is None and (all_follow or self._told_to_start):
            self._begin_path(time, position)
        velocity = np.zeros(3)
        if self._origin is not None:
            velocity = self._path.update(time - self._origin, position)
        self._velocity, self._time = velocity.tolist(), time
        return velocity

    def _begin_path(self, time, position):
        if not np.isfinite([time, *position]).all():
            return
        # A new node may find a leader that is on its way already.
        passed = self._path.time_at(position) if time > 0.0 else 0.0
        self._origin = time - passed


def _three_finite(values, name):
    array = np.asarray(values, dtype=float)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise ValueError(f"the {name} is {list(values)}; it must be three finite numbers")
    return array.tolist()
