"""Frames of a run from a bag, without ROS."""

from pathlib import Path

import numpy as np
import yaml
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from deformable_manipulation.recording.bag_index import DAMAGED, open_bag
from deformable_manipulation.recording.bag_run_info import TOPIC, connections_of, read_run_info
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.run_data import RunDataError
from deformable_manipulation.scenario import ScenarioError, scenario_from_mapping
from deformable_manipulation.scenario.spec import FabricSpec, Scenario

OBJECT_STATE = "deformable_manipulation/msg/ObjectState"


def read_bag_frames(path: Path, namespace: str = "") -> Frames:
    """The frames of the last run in a bag that was recorded with ``record:=true``.

    Raises RunDataError: the bag is damaged, or has no states or no description of the run.
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
        f"{path} holds no {TOPIC}, which tells its scenario; record with record:=true"
    )


def _read_states(path: Path, reader: Reader, scenario: Scenario, namespace: str) -> Frames:
    connections = connections_of(reader, OBJECT_STATE, namespace)
    if not connections:
        raise RunDataError(f"{path} holds no states of the object; record the topic state")
    types = get_typestore(Stores.ROS1_NOETIC)
    types.register(get_types_from_msg(connections[0].msgdef.data, OBJECT_STATE))
    every = max(1, round(scenario.controller.rate / scenario.simulation.record_rate))
    frames, last = {}, (-1, -1)
    for _, _, data in reader.messages(connections[:1]):
        state = types.deserialize_ros1(data, OBJECT_STATE)
        run = (state.reset_count, state.cycle)
        if run[0] != last[0] or run[1] < last[1]:
            frames = {}  # a reset or a restart: only the last run counts
        last = run
        if state.cycle % every == 0:
            frames[state.cycle] = _frame(state, scenario)
    if not frames:
        raise RunDataError(f"{path} holds no state of the object")
    cycles = sorted(frames)
    points, agents = zip(*(frames[cycle] for cycle in cycles))
    faces = scenario.object.triangles if isinstance(scenario.object, FabricSpec) else None
    return Frames(
        scenario,
        np.array(cycles) * scenario.cycle_time,
        np.stack(points),
        np.stack(agents),
        None if faces is None else np.array(faces),
    )


def _frame(state, scenario: Scenario):
    """Points (P, 3) of the object itself and held points (A, 3) of a state."""
    points = np.asarray(state.points[: 3 * state.point_count]).reshape(-1, 3)
    positions = np.asarray(state.agent_positions).reshape(-1, 3)
    order = [state.agents.index(agent.name) for agent in scenario.agents]
    return points.astype(np.float32), positions[order].astype(np.float32)
