"""Bags with this package's messages, written without ROS from the definitions in msg/."""

from pathlib import Path

import numpy as np
import yaml
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from synthetic_run import RATE, make_decision

from deformable_manipulation.scenario import scenario_to_mapping

MESSAGES = Path(__file__).resolve().parents[3] / "msg"
PACKAGE = "deformable_manipulation/msg/"
CONTROLLER_STATE = PACKAGE + "ControllerState"
DISTANCES = PACKAGE + "Distances"
OBJECT_STATE = PACKAGE + "ObjectState"
STAMP_ZERO = 1700000000250000000  # ns, a wall clock's
VECTORS = {
    "position": "position",
    "target": "target",
    "error": "error",
    "nominal_velocity": "nominal",
    "velocity": "command",
    "jacobian": "jacobian",
}


def make_typestore(**definitions):
    """Types of this package; ``definitions`` replace the text of some messages."""
    typestore = get_typestore(Stores.ROS1_NOETIC)
    for name in ("ControllerState", "Distances", "ObjectState"):
        text = definitions.get(name) or (MESSAGES / f"{name}.msg").read_text()
        typestore.register(get_types_from_msg(text, PACKAGE + name))
    return typestore


class BagWriter:
    """Writes the messages of runs, cycle by cycle; receive times grow with every message."""

    def __init__(self, path, typestore=None, compression=None):
        self.typestore = typestore or make_typestore()
        self._writer = Writer(path)
        if compression:
            self._writer.set_compression(compression)
        self._connections = {}
        self._received = 10**9

    def __enter__(self):
        self._writer.open()
        return self

    def __exit__(self, *exception):
        self._writer.close()

    def write(self, topic, msgtype, message):
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(
                topic, msgtype, typestore=self.typestore
            )
        data = self.typestore.serialize_ros1(message, msgtype)
        self._received += 1000
        self._writer.write(self._connections[topic], self._received, data)

    def controller_state(self, cycle, agent="assistant_1", namespace="", reset_count=0, **changes):
        decision = make_decision(cycle)
        values = {
            f"{field}_{axis}": float(number)
            for field, attribute in VECTORS.items()
            for axis, number in zip("xyz", getattr(decision, attribute))
        }
        for field in ("orientation_error", "nominal_angular_velocity", "angular_velocity"):
            values.update({f"{field}_{axis}": 0.0 for axis in "xyz"})
        for field in (
            "distance exact_jacobian leader_drift rows solve_time computation_time error_norm "
            "enabled coordinated"
        ).split():
            values[field] = getattr(decision, field)
        values.update(
            barriers=list(decision.h),
            h=np.array(list(decision.h.values())),
            slack=np.array(list(decision.slack.values())),
        )
        for name, h in decision.h.items():
            values.update({f"h_{name}": h, f"slack_{name}": decision.slack[name]})
        values.update(status=int(decision.status), status_text="", agent=agent)
        values.update(overruns=0, skipped_states=0, **changes)
        message = self._message(CONTROLLER_STATE, cycle, reset_count, values)
        self.write(f"{namespace}/{agent}/controller_state", CONTROLLER_STATE, message)

    def distances(self, cycle, namespace="", reset_count=0, minimum=None, obstacle_poses=()):
        minimum = make_decision(cycle).distance if minimum is None else minimum
        numbers = {
            name: np.zeros(0, dtype)
            for name, dtype in (
                ("feature_distances", float),
                ("feature_obstacles", np.int32),
                ("object_points", float),
                ("obstacle_points", float),
                ("normals", float),
                ("obstacle_velocities", float),
                ("feature_identities", np.int64),
                ("feature_vertices", np.uint32),
                ("feature_weights", float),
            )
        }
        values = dict(
            numbers,
            obstacles=["ground"],
            moving_obstacles=[f"obstacle_{k}" for k in range(len(obstacle_poses))],
            obstacle_poses=np.ravel(obstacle_poses).astype(float),
            fault="",
            minimum_distances=np.array([minimum, 7.0]),
            feature_offsets=np.zeros(3, np.uint32),
            computation_time=1e-4,
        )
        message = self._message(DISTANCES, cycle, reset_count, values)
        self.write(f"{namespace}/distances", DISTANCES, message)

    def object_state(self, cycle, points, agents, namespace="", reset_count=0):
        """A state of points (P, 3) and of agents, positions by name in the message's order."""
        values = dict(
            object_type=0,
            particle_count=len(points) - 1,
            point_count=len(points),
            agents=list(agents),
            agent_particles=np.zeros(len(agents), np.int32),
            further_particles=np.zeros(0, np.int32),
            further_agents=np.zeros(0, np.int32),
            displaced_agents=np.array([-1], np.int32),
            copy_ready=np.array([1], np.uint8),
            agent_positions=np.concatenate(list(agents.values())),
            points=np.concatenate((points.ravel(), np.full(points.size, 9.0))),  # and of a copy
        )
        for name in (
            "agent_orientations agent_velocities agent_angular_velocities displacements "
            "orientations velocities measured_velocities correction sensitivities "
            "turning_sensitivities wrenches wrench_sensitivities"
        ).split():
            values[name] = np.zeros(0)
        message = self._message(OBJECT_STATE, cycle, reset_count, values)
        self.write(f"{namespace}/state", OBJECT_STATE, message)

    def run_info(self, scenario, topic="/run_info"):
        text = yaml.safe_dump({"scenario": scenario_to_mapping(scenario)}, sort_keys=False)
        message = self.typestore.types["std_msgs/msg/String"](data=text)
        self.write(topic, "std_msgs/msg/String", message)

    def cycle(self, cycle, **keywords):
        """The distances and the state of one controller."""
        self.distances(cycle, **keywords)
        self.controller_state(cycle, **keywords)

    def _message(self, msgtype, cycle, reset_count, values):
        types = self.typestore.types
        nanoseconds = STAMP_ZERO + round(cycle * 1e9 / RATE)
        stamp = types["builtin_interfaces/msg/Time"](*divmod(nanoseconds, 10**9))
        header = types["std_msgs/msg/Header"](seq=0, stamp=stamp, frame_id="map")
        known = {name for name, _ in self.typestore.fielddefs[msgtype][1]}
        values = {name: value for name, value in values.items() if name in known}
        return types[msgtype](header=header, cycle=cycle, reset_count=reset_count, **values)
