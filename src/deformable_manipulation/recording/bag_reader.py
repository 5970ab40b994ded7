"""Reads a run from a bag, without ROS: the messages' definitions come from the bag itself."""

from dataclasses import replace
from pathlib import Path
from typing import Dict, List, Optional, Tuple

import yaml
from rosbags.rosbag1 import Reader

from deformable_manipulation.recording.bag_index import DAMAGED, open_bag
from deformable_manipulation.recording.bag_run_info import namespace_of, read_run_info
from deformable_manipulation.recording.bag_track import (
    CONTROLLER_STATE,
    DISTANCES,
    Track,
    read_track,
)
from deformable_manipulation.recording.run_data import (
    RunData,
    RunDataError,
    make_assistant_series,
    offset_of,
)


def read_bag(path: Path, namespace: Optional[str] = None) -> RunData:
    """Read the last run in a bag; see :func:`deformable_manipulation.recording.read_run`.

    Topics are found by their type; a run lasts from one reset or start to the next.

    Raises:
        RunDataError: no bag, damaged, without controller states, or with several namespaces when
            none is given.
    """
    with open_bag(path) as (reader, notes):
        try:
            topics = _topics_of_run(path, reader, namespace)
            tracks = [read_track(reader, topic) for topic in topics]
            chosen = namespace_of(namespace_of(topics[-1]))
            scenario = _scenario_name(reader, chosen)
        except DAMAGED as error:
            raise RunDataError(f"{path} is damaged: {error}") from error
    present = [track for track in tracks if track is not None]
    controllers = [track for track in present if track.agent]
    if not controllers:
        raise RunDataError(f"{path}: no controller has published a state")
    distances = next((track for track in present if not track.agent), controllers[0])
    run = _assemble(path, distances, controllers, notes)
    return replace(run, scenario=scenario, namespace=chosen)


def _scenario_name(reader: Reader, namespace: str) -> str:
    """The name of the scenario; empty if it is missing or cannot be read."""
    try:
        return str(read_run_info(reader, namespace)["scenario"]["name"])
    except (yaml.YAMLError, KeyError, TypeError):
        return ""


def _topics_of_run(path: Path, reader: Reader, namespace: Optional[str]) -> List[str]:
    """Topics of one run: its distances, if recorded, and the controllers' states."""
    types = {connection.topic: connection.msgtype for connection in reader.connections}
    controllers: Dict[str, List[str]] = {}
    for topic, msgtype in sorted(types.items()):
        if msgtype == CONTROLLER_STATE:
            # <namespace>/<agent>/controller_state
            controllers.setdefault(namespace_of(namespace_of(topic)), []).append(topic)
    if not controllers:
        content = [f"{topic} ({types[topic]})" for topic in sorted(types)]
        raise RunDataError(
            "{} contains no deformable_manipulation/msg/ControllerState; record the topics "
            "<agent>/controller_state and distances. It holds: {}".format(
                path, ", ".join(content) or "nothing"
            )
        )
    chosen = _choose_namespace(path, list(controllers), namespace)
    distances = [
        topic
        for topic, msgtype in sorted(types.items())
        if msgtype == DISTANCES and namespace_of(topic) == chosen
    ]
    return distances[:1] + controllers[chosen]


def _choose_namespace(path: Path, present: List[str], wanted: Optional[str]) -> str:
    names = ", ".join(name or "/" for name in present)
    if wanted is None:
        if len(present) > 1:
            raise RunDataError(
                f"{path} contains several runs; choose one with --namespace: {names}"
            )
        return present[0]
    for name in present:
        if name.strip("/") == wanted.strip("/"):
            return name
    raise RunDataError(f"{path} contains no namespace {wanted}; it contains: {names}")


def _assemble(
    path: Path, distances: Track, controllers: List[Track], notes: Tuple[str, ...]
) -> RunData:
    """The last run of the bag; ``distances`` identify it."""
    reference, runs = distances.last_run()
    if runs > 1:
        notes += (f"the bag holds {runs} runs (resets or restarts); this is the last",)
    start = _start(reference)
    assistants = []
    for controller in controllers:
        track, _ = controller.last_run()
        same_reset = track.reset_count[-1] == reference.reset_count[-1]
        if not same_reset or track.received[-1] < reference.received[0]:
            notes += (f"{controller.agent} sent nothing in the last run and is left out",)
            continue
        time = 1e-9 * (track.stamp - start)
        distance = track.columns["distance"]
        assistants.append(make_assistant_series(track.agent, time, distance, track.columns))
    if not assistants:
        raise RunDataError(f"{path}: no controller has published a state in the last run")
    return RunData(
        name=path.name.partition(".bag")[0],
        path=path,
        time=1e-9 * (reference.stamp - start),
        distance=reference.columns["distance"],
        offset=offset_of(tuple(assistants)),
        assistants=tuple(assistants),
        notes=notes,
    )


def _start(track: Track) -> int:
    """The stamp [ns] of cycle 0, which a recorder that started late has not seen."""
    first_stamp, first_cycle = int(track.stamp[0]), int(track.cycle[0])
    cycles = int(track.cycle[-1]) - first_cycle
    if cycles == 0:
        return first_stamp
    return first_stamp - first_cycle * (int(track.stamp[-1]) - first_stamp) // cycles
