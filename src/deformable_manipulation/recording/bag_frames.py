"""Frames of a run from a bag, without ROS."""

from pathlib import Path
from typing import Callable

import numpy as np
import yaml
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from deformable_manipulation.motion.obstacle_motion import moving_obstacles
from deformable_manipulation.recording.bag_index import DAMAGED, open_bag
from deformable_manipulation.recording.bag_run_info import TOPIC, connections_of, read_run_info
from deformable_manipulation.recording.bag_track import DISTANCES
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.run_data import RunDataError
from deformable_manipulation.scenario import ScenarioError, scenario_from_mapping
from deformable_manipulation.scenario.spec import Scenario

OBJECT_STATE = "deformable_manipulation/msg/ObjectState"


def read_bag_frames(path: Path, namespace: str = "") -> Frames:
    """The frames of the last run in a bag that was recorded with ``record:=true``.

    Raises:
        RunDataError: the bag is damaged, or has no states or no description of the run.
    """
    with open_bag(path) as (reader, _):
        try:
            scenario = _read_scenario(path, reader, namespace)
            return _read_states(path, reader, scenario, namespace)
        except DAMAGED as error:
            raise RunDataError(f"{path} is damaged: {error}") from error


def _read_scenario(path: Path, reader: Reader, namespace: str) -> Scenario:
    try:
        info = read_run_info(reader, namespace)
        if info is not None:
            return scenario_from_mapping(info["scenario"], path.parent)
    except (yaml.YAMLError, KeyError, TypeError, ScenarioError) as error:
        raise RunDataError(f"{path}: the scenario in it cannot be read: {error}") from error
    raise RunDataError(
        f"{path} contains no {TOPIC}, which holds its scenario; record with record:=true"
    )


def _read_states(path: Path, reader: Reader, scenario: Scenario, namespace: str) -> Frames:
    if not connections_of(reader, OBJECT_STATE, namespace):
        raise RunDataError(f"{path} contains no states of the object; record the topic state")
    every = max(1, round(scenario.controller.rate / scenario.simulation.record_rate))
    states = _messages(reader, OBJECT_STATE, namespace)
    frames = _of_last_run(states, every, lambda state: _frame(state, scenario))
    if not frames:
        raise RunDataError(f"{path} contains no state of the object")
    cycles = sorted(frames)
    points, agents = zip(*(frames[cycle] for cycle in cycles))
    return Frames(
        scenario,
        np.array(cycles) * scenario.cycle_time,
        np.stack(points),
        np.stack(agents),
        _read_obstacles(reader, scenario, namespace, cycles, every),
    )


def _of_last_run(messages, every: int, read: Callable) -> dict:
    """What is read of every so many-th cycle of the last run, by cycle."""
    found, last = {}, (-1, -1)
    for message in messages:
        run = (message.reset_count, message.cycle)
        if run[0] != last[0] or run[1] < last[1]:
            found = {}  # a reset or a restart: only the last run counts
        last = run
        if message.cycle % every == 0:
            found[message.cycle] = read(message)
    return found


def _read_obstacles(reader: Reader, scenario: Scenario, namespace: str, cycles, every: int):
    """Poses (F, K, 7) of the moving obstacles; None if none moves or they are not recorded.

    A cycle without distances has the poses of the one before.
    """
    moving = len(moving_obstacles(scenario))
    if not moving:
        return None
    poses = _of_last_run(
        _messages(reader, DISTANCES, namespace),
        every,
        lambda distances: np.asarray(distances.obstacle_poses).reshape(moving, 7),
    )
    known = sorted(poses)
    if not known:
        return None
    places = np.maximum(np.searchsorted(known, cycles, side="right") - 1, 0)
    return np.stack([poses[known[place]] for place in places])


def _frame(state, scenario: Scenario):
    """Points (P, 3) of the object itself and held points (A, 3) of a state."""
    points = np.asarray(state.points[: 3 * state.point_count]).reshape(-1, 3)
    positions = np.asarray(state.agent_positions).reshape(-1, 3)
    order = [state.agents.index(agent.name) for agent in scenario.agents]
    return points.astype(np.float32), positions[order].astype(np.float32)


def _messages(reader: Reader, msgtype: str, namespace: str):
    """The messages of the first topic of a type."""
    connections = connections_of(reader, msgtype, namespace)[:1]
    if connections:
        types = get_typestore(Stores.ROS1_NOETIC)
        types.register(get_types_from_msg(connections[0].msgdef.data, msgtype))
        for _, _, data in reader.messages(connections):
            yield types.deserialize_ros1(data, msgtype)
