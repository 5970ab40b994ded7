"""Messages to the core's arrays and back.

The messages are read and written through ``rospy.numpy_msg``, so their arrays are numpy arrays.
Agents are matched by name: a message may list them in another order than the scenario.
"""

import math

import genpy
import numpy as np
from geometry_msgs.msg import PoseStamped

from deformable_manipulation import _control
from deformable_manipulation.control.observation import Observation
from deformable_manipulation.distance.features import Distances
from deformable_manipulation.motion.intent import Intent

PLAIN_BARRIERS = ("collision", "overstretch", "proximity")  # with scalars in ControllerState


class MessageError(ValueError):
    """A message that does not fit the scenario or itself; the text names the field."""


def points_of(state) -> np.ndarray:
    """Geometry points (C, P, 3) [m] of all copies in an ``ObjectState``.

    Raises:
        MessageError: the array's size does not fit.
    """
    return _reshaped(state.points, "points", (len(state.displaced_agents), state.point_count, 3))


def agent_order(state, scenario) -> np.ndarray:
    """Rows (A,) of the message's agents in the scenario's order.

    Raises:
        MessageError: an agent of the scenario is not in the message.
    """
    rows = {name: row for row, name in enumerate(state.agents)}
    missing = [agent.name for agent in scenario.agents if agent.name not in rows]
    if missing:
        raise MessageError(f"agents: {', '.join(missing)} of the scenario missing")
    return np.array([rows[agent.name] for agent in scenario.agents])


def agent_positions(state, scenario) -> np.ndarray:
    """Held points (A, 3) [m] in the scenario's order. Raises MessageError."""
    positions = _reshaped(state.agent_positions, "agent_positions", (len(state.agents), 3))
    return positions[agent_order(state, scenario)]


def agent_orientations(state, scenario) -> np.ndarray:
    """Orientations (A, 4) of the held particles in the scenario's order. Raises MessageError."""
    turns = _reshaped(state.agent_orientations, "agent_orientations", (len(state.agents), 4))
    return turns[agent_order(state, scenario)]


def to_observation(state, distances, scenario, age=0.0, intent=None, obstacles=None) -> Observation:
    """What a controller sees, from an ``ObjectState`` and the core's ``Distances`` of it.

    Time counts from the start of the run: cycles of the scenario's rate. ``age`` [s] is that of the
    state: commands act when a cycle starts, so each whole cycle that has passed makes them late by
    one. ``intent``: the leader's Intent. ``obstacles``: (K, 7) poses of those that move.

    Raises:
        MessageError: another frame, an array's size does not fit, or an agent is missing.
    """
    require_frame("state", state, scenario)
    order = agent_order(state, scenario)
    scenario_index = np.full(len(state.agents) + 1, -1)
    scenario_index[order] = range(len(order))
    copies = len(state.displaced_agents)
    displaced = np.asarray(state.displaced_agents)
    if ((displaced < -1) | (displaced >= len(state.agents))).any():
        raise MessageError(
            f"displaced_agents: {displaced.tolist()}, but there are {len(state.agents)} agents"
        )
    return Observation(
        time=state.cycle * scenario.cycle_time,
        cycle=state.cycle,
        positions=agent_positions(state, scenario),
        points=points_of(state),
        displaced_agents=scenario_index[displaced],
        displacements=_reshaped(state.displacements, "displacements", (copies, 3)),
        ready=_flags(state.copy_ready, "copy_ready", copies),
        distances=distances,
        velocities=_measured_velocities(state, order),
        **_turning(state, order, scenario),
        sensitivities=_sensitivities(state, order),
        wrenches=_wrenches(state, order),
        wrench_sensitivities=_wrench_sensitivities(state, order),
        correction=_correction(state),
        obstacles=obstacles,
        intent=intent,
        lateness=_whole_cycles(age, scenario.cycle_time),
    )


def _whole_cycles(age, cycle_time):
    """The part of an age [s] that is whole cycles; none of a state from the future."""
    return cycle_time * max(0, math.floor(age / cycle_time))


def require_frame(name, message, scenario):
    """Raises MessageError: a message, called so, is not in the scenario's frame."""
    if message.header.frame_id != scenario.frame:
        raise MessageError(
            f"{name}.header.frame_id: '{message.header.frame_id}', expected '{scenario.frame}'"
        )


def _correction(state):
    """(P, 3) [m], or None. Raises MessageError."""
    if not len(state.correction):
        return None
    return _reshaped(state.correction, "correction", (state.point_count, 3))


def _measured_velocities(state, order):
    """(A, 3) [m/s] in the scenario's order, or None. Raises MessageError."""
    if not len(state.measured_velocities):
        return None
    shape = (len(state.agents), 3)
    return _reshaped(state.measured_velocities, "measured_velocities", shape)[order]


def _sensitivities(state, order):
    """(A, P, 3, 3) in the scenario's order, or None. Raises MessageError."""
    if not len(state.sensitivities):
        return None
    shape = (len(state.agents), state.point_count, 3, 3)
    return _reshaped(state.sensitivities, "sensitivities", shape)[order]


def _turning(state, order, scenario):
    """What is known of the grips' orientations, if they turn. Raises MessageError."""
    if not scenario.controller.turns:
        return {}
    agents = len(state.agents)
    sensitivities = None
    if len(state.turning_sensitivities):
        shape = (agents, state.point_count, 3, 3)
        values = _reshaped(state.turning_sensitivities, "turning_sensitivities", shape)
        sensitivities = values[order]
    return dict(
        orientations=_reshaped(state.agent_orientations, "agent_orientations", (agents, 4))[order],
        turning_sensitivities=sensitivities,
    )


def _wrenches(state, order):
    """(C, A, 6) in the scenario's order, or None. Raises MessageError."""
    if not len(state.wrenches):
        return None
    shape = (len(state.displaced_agents), len(state.agents), 6)
    return _reshaped(state.wrenches, "wrenches", shape)[:, order]


def _wrench_sensitivities(state, order):
    """(A, 6, A, 6) in the scenario's order, or None. Raises MessageError."""
    if not len(state.wrench_sensitivities):
        return None
    agents = len(state.agents)
    shape = (agents, 6, agents, 6)
    return _reshaped(state.wrench_sensitivities, "wrench_sensitivities", shape)[order][:, :, order]


def to_distances(message) -> Distances:
    """The core's result from a ``Distances`` message.

    Raises:
        MessageError: an array's size does not fit, or the message tells a fault.
    """
    if message.fault:
        raise MessageError(message.fault)
    features = len(message.feature_distances)
    vectors = (features, 3)
    arrays = dict(
        minimum=message.minimum_distances,
        offsets=np.asarray(message.feature_offsets, dtype=np.int64),
        distance=message.feature_distances,
        obstacle=message.feature_obstacles,
        object_point=_reshaped(message.object_points, "object_points", vectors),
        obstacle_point=_reshaped(message.obstacle_points, "obstacle_points", vectors),
        normal=_reshaped(message.normals, "normals", vectors),
        vertices=_reshaped(message.feature_vertices, "feature_vertices", vectors).astype(np.int64),
        weights=_reshaped(message.feature_weights, "feature_weights", vectors),
        obstacle_velocity=_obstacle_velocities(message.obstacle_velocities, vectors),
        identity=_reshaped(message.feature_identities, "feature_identities", (features,)),
    )
    try:
        return Distances(**arrays, names=list(message.obstacles))
    except ValueError as error:
        raise MessageError(str(error)) from error


def to_obstacle_poses(message) -> np.ndarray:
    """Poses (K, 7) of the moving obstacles in a ``Distances`` message. Raises MessageError."""
    return _reshaped(message.obstacle_poses, "obstacle_poses", (len(message.moving_obstacles), 7))


def _obstacle_velocities(values, shape):
    """Zeros where none are told. Raises MessageError."""
    return _reshaped(values, "obstacle_velocities", shape) if len(values) else np.zeros(shape)


def fill_distances(message, state, distances, computation_time, moving=(), poses=(), fault=""):
    """Write the distances of a state into a ``Distances`` message.

    ``moving``: names of the K moving obstacles, ``poses``: where they are, (K, 7).
    """
    message.header = state.header
    message.cycle = state.cycle
    message.reset_count = state.reset_count
    message.obstacles = list(distances.names)
    message.minimum_distances = distances.minimum
    message.feature_offsets = distances.offsets.astype(np.uint32)
    message.feature_distances = distances.distance
    message.feature_obstacles = distances.obstacle.astype(np.int32)
    message.object_points = distances.object_point.ravel()
    message.obstacle_points = distances.obstacle_point.ravel()
    message.normals = distances.normal.ravel()
    message.obstacle_velocities = distances.obstacle_velocity.ravel() if moving else np.zeros(0)
    message.feature_vertices = distances.vertices.astype(np.uint32).ravel()
    message.feature_weights = distances.weights.ravel()
    message.feature_identities = distances.identity
    message.moving_obstacles = list(moving)
    message.obstacle_poses = np.ravel(poses)
    message.fault = fault
    message.computation_time = computation_time
    return message


def fill_controller_state(message, state, agent, decision):
    """Write a controller's decision on a state into a ``ControllerState`` message."""
    message.header = state.header
    message.cycle = state.cycle
    message.reset_count = state.reset_count
    message.agent = agent
    message.enabled = decision.enabled
    message.status = int(decision.status)
    message.status_text = decision.text
    message.exact_jacobian = decision.exact_jacobian
    message.coordinated = decision.coordinated
    for name, vector in (
        ("position", decision.position),
        ("target", decision.target),
        ("error", decision.error),
        ("nominal_velocity", decision.nominal),
        ("velocity", decision.command),
        ("jacobian", decision.jacobian),
        ("orientation_error", decision.orientation_error),
        ("nominal_angular_velocity", decision.angular_nominal),
        ("angular_velocity", decision.angular_command),
    ):
        for axis, value in zip("xyz", vector):
            setattr(message, f"{name}_{axis}", float(value))
    for name in (
        "error_norm",
        "distance",
        "leader_drift",
        "rows",
        "solve_time",
        "computation_time",
    ):
        setattr(message, name, getattr(decision, name))
    _fill_barriers(message, decision)
    return message


def _fill_barriers(message, decision):
    """The barriers' values, as lists and, of those of the paper, as scalars for plotting tools."""
    message.barriers = list(decision.h)
    message.h = np.array(list(decision.h.values()), dtype=float)
    message.slack = np.array(list(decision.slack.values()), dtype=float)
    for name in PLAIN_BARRIERS:
        setattr(message, f"h_{name}", decision.h.get(name, math.nan))
        setattr(message, f"slack_{name}", decision.slack.get(name, 0.0))


def to_leader_intent(message, state, scenario) -> Intent:
    """The leader's Intent from a ``nav_msgs/Path``, in the time of a state's run.

    The stamps of the poses say when the leader will be there, by the clock of the state's stamp.

    Raises:
        MessageError: another frame, or it cannot be used.
    """
    require_frame("intent", message, scenario)
    now = state.cycle * scenario.cycle_time
    places = [each.pose.position for each in message.poses]
    try:
        return Intent(
            np.array(
                [now + (each.header.stamp - state.header.stamp).to_sec() for each in message.poses]
            ),
            np.array([(place.x, place.y, place.z) for place in places]),
        )
    except ValueError as error:
        raise MessageError(str(error)) from error


def fill_path(message, state, cycle_time, frame, intent):
    """Write the Intent with which a leader answers a state into a ``nav_msgs/Path``.

    ``None``: nothing is announced, and the path is empty.
    """
    message.header.stamp, message.header.frame_id = state.header.stamp, frame
    if intent is None:
        return message
    for ahead, place in zip(intent.times - state.cycle * cycle_time, intent.positions.tolist()):
        pose = PoseStamped()
        # from_sec() would cut off what is less than a nanosecond.
        pose.header.stamp = state.header.stamp + genpy.Duration(0, round(1e9 * ahead))
        pose.header.frame_id = frame
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = place
        pose.pose.orientation.w = 1.0
        message.poses.append(pose)
    return message


def to_twist(message, state, velocity, angular=(0.0, 0.0, 0.0)):
    """Write velocities (3,) [m/s] and [rad/s] that answer a state into a ``TwistStamped``."""
    message.header = state.header
    for part, vector in ((message.twist.linear, velocity), (message.twist.angular, angular)):
        part.x, part.y, part.z = (float(value) for value in vector)
    return message


def to_measured_wrench(message, scenario):
    """Arguments of ``WrenchWatch.measured`` from a ``WrenchStamped``, but for the name."""
    frame = message.header.frame_id
    return dict(
        stamp=message.header.stamp.to_sec(),
        force=_vector(message.wrench.force),
        torque=_vector(message.wrench.torque),
        problem="" if frame == scenario.frame else f"is in the frame '{frame}'",
    )


def fill_intent(message, state, agent, intent):
    """Write how an assistant goes on from a state into an ``AssistantIntent`` message."""
    message.header = state.header
    message.cycle = state.cycle
    message.reset_count = state.reset_count
    message.agent = agent
    message.follows = intent.follows
    message.hears = intent.hears
    message.coordinated = intent.coordinated
    for field, vector in (
        (message.reference, intent.reference),
        (message.velocity, intent.command),
        (message.acceleration, intent.acceleration),
        (message.departure, intent.departure),
        (message.angular_velocity, intent.angular_command),
        (message.angular_acceleration, intent.angular_acceleration),
        (message.angular_departure, intent.angular_departure),
    ):
        field.x, field.y, field.z = vector.tolist()
    return message


def to_intent(message, scenario):
    """The core's ``_control.AssistantIntent`` from an ``AssistantIntent`` message.

    Raises:
        MessageError: a number is not finite.
    """
    try:
        return _control.AssistantIntent(
            time=message.cycle * scenario.cycle_time,
            follows=message.follows,
            hears=message.hears,
            coordinated=message.coordinated,
            reference=_vector(message.reference),
            command=_vector(message.velocity),
            acceleration=_vector(message.acceleration),
            departure=_vector(message.departure),
            angular_command=_vector(message.angular_velocity),
            angular_acceleration=_vector(message.angular_acceleration),
            angular_departure=_vector(message.angular_departure),
        )
    except ValueError as error:
        raise MessageError(str(error)) from None


def _vector(message):
    return message.x, message.y, message.z


def _flags(values, name, count):
    """Flags (count,) from an array of uint8, which rospy gives as bytes."""
    return _reshaped(np.frombuffer(bytes(values), dtype=np.uint8), name, (count,)) != 0


def _reshaped(values, name, shape):
    array = np.asarray(values)
    if array.size != math.prod(shape):  # numpy's takes ten times longer
        raise MessageError(f"{name}: {array.size} numbers, expected {' x '.join(map(str, shape))}")
    return array.reshape(shape)
