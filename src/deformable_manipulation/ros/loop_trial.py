"""A run in real time, watched from outside: latency of the commands, load of the nodes."""

import os
import re
import subprocess
import time
import xmlrpc.client
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Optional, Tuple

import numpy as np
import rosgraph
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from deformable_manipulation.control.status import Status
from deformable_manipulation.ros.launched_run import launch_command
from deformable_manipulation.system.process_usage import usage_of
from deformable_manipulation.system.program import Program, ProgramError

_START = 120.0  # s, for the object to settle and all nodes to work
_PATIENCE = 30.0  # s, beyond the recording's length
_CALLER = "/loop_trial"
_OVERRUNS = re.compile(r"/(\S+): Overruns: (\d+) of \d+ cycles(?:, (\d+) states? skipped)?\.")


@dataclass(frozen=True)
class NodeLoad:
    """What one node took of the machine."""

    share: float  # of one core
    memory: int  # bytes (PSS) at the end
    overruns: Optional[int]  # cycles, of the whole run; None: the node does not say
    skipped: Optional[int]  # states, of the whole run; None: the node does not say


@dataclass(frozen=True)
class Commands:
    """The N commands of an assistant, in their order."""

    stamps: np.ndarray  # (N,) s, of the states that they answer
    latencies: np.ndarray  # (N,) s, from the stamp to the receipt
    status: str = ""  # name of the controller's status after the last of them

    @property
    def rate(self) -> float:
        """Commands per second [Hz]; nan for fewer than two."""
        return (len(self.stamps) - 1) / np.ptp(self.stamps) if len(self.stamps) > 1 else np.nan

    def answered(self, rate: float) -> float:
        """The share of the states, of which there are ``rate`` per second [Hz], that got one."""
        return len(self.stamps) / (round(np.ptp(self.stamps) * rate) + 1)


@dataclass(frozen=True)
class LoopMeasurement:
    """Commands and loads of a run in real time."""

    commands: Dict[str, Commands]  # by assistant
    nodes: Dict[str, NodeLoad]


def watch_loop(scenario, directory, seconds, warm_up, one_process=True) -> LoopMeasurement:
    """Run a scenario in real time and measure it.

    The commands are recorded by ``rosbag record``, a process of its own, whose time of receipt is
    compared with the stamp of the state that a command answers.

    Args:
        scenario: the checked scenario.
        directory: existing folder for files.
        seconds: how long it is measured.
        warm_up: time [s] from the first command until then.
        one_process: distances and controllers in one process.

    Raises:
        ProgramError: the run does not start or ends by itself.
    """
    directory = Path(directory)
    assistants = [scenario.agents[index].name for index in scenario.assistants]
    nodes = _nodes(assistants, one_process)
    command = launch_command(
        scenario, directory, lockstep="false", one_process=str(one_process).lower()
    )
    log = directory / "run.log"
    environment = {**os.environ, "ROSCONSOLE_FORMAT": "${node}: ${message}"}
    with Program("the run", command, log, environment) as run:
        topics = [f"/{name}/cmd_vel" for name in assistants]
        _record(topics, _START, directory / "first.bag", limit=1)  # all of them work
        run.check()
        pids = {node: _pid_of(node) for node in nodes}
        _record(topics, warm_up, directory / "warm_up.bag")
        before = {node: usage_of(pid) for node, pid in pids.items()}
        started = time.monotonic()
        _record(topics, seconds, directory / "commands.bag")
        elapsed = time.monotonic() - started
        after = {node: usage_of(pid) for node, pid in pids.items()}
        states = [f"/{name}/controller_state" for name in assistants]
        _record(states, _PATIENCE, directory / "states.bag", limit=1)
        run.check()
    overruns = read_overruns(log.read_text(errors="replace"))
    loads = {
        node: NodeLoad(
            (after[node].processor - before[node].processor) / elapsed,
            after[node].memory,
            *overruns.get(node, (None, None)),
        )
        for node in nodes
    }
    return LoopMeasurement(_read_commands(directory, assistants), loads)


def read_overruns(log: str) -> Dict[str, Tuple[int, Optional[int]]]:
    """What each node says, when it leaves, of its overruns and of the states that it skipped."""
    return {
        name: (int(overruns), int(skipped) if skipped else None)
        for name, overruns, skipped in _OVERRUNS.findall(log)
    }


def _nodes(assistants, one_process) -> List[str]:
    if one_process:
        return ["simulator", "leader", "assistants"]
    controllers = [f"{name}_controller" for name in assistants]
    return ["simulator", "leader", "minimum_distance", *controllers]


def _record(topics: List[str], seconds: float, path: Path, limit=None) -> None:
    """Record topics for a time, or until there are ``limit`` messages of each."""
    command = ["rosbag", "record", "--quiet", "--tcpnodelay", "-O", str(path)]
    command += ["--duration", str(seconds)] + (["--limit", str(limit)] if limit else []) + topics
    try:
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds + _PATIENCE
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ProgramError(f"the commands cannot be recorded: {error}") from error
    if done.returncode != 0 or not path.exists():
        printed = done.stdout.decode(errors="replace").strip()
        raise ProgramError(f"the commands cannot be recorded: {printed or done.returncode}")


def _pid_of(node: str) -> int:
    try:
        address = rosgraph.Master(_CALLER).lookupNode("/" + node)
        with xmlrpc.client.ServerProxy(address) as api:
            return api.getPid(_CALLER)[2]
    except (rosgraph.MasterException, OSError, xmlrpc.client.Error) as error:
        raise ProgramError(f"the node {node} does not answer: {error}") from error


def _read_commands(directory: Path, assistants) -> Dict[str, Commands]:
    states = {name: state for name, _, state in _read(directory / "states.bag")}
    found: Dict[str, List[Tuple[int, int]]] = {name: [] for name in assistants}
    for name, received, command in _read(directory / "commands.bag"):
        stamp = command.header.stamp
        sent = stamp.sec * 10**9 + stamp.nanosec
        found[name].append((sent, received - sent))
    missing = [name for name, pairs in found.items() if not pairs or name not in states]
    if missing:
        raise ProgramError(f"no commands or states came from {', '.join(missing)}")
    return {
        name: Commands(*(1e-9 * np.array(pairs).T), Status(states[name].status).name)
        for name, pairs in found.items()
    }


def _read(path: Path):
    """Agent, time of receipt [ns] and message, one by one."""
    with Reader(path) as reader:
        types = get_typestore(Stores.ROS1_NOETIC)
        for connection in reader.connections:
            types.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
        for connection, received, data in reader.messages():
            message = types.deserialize_ros1(data, connection.msgtype)
            yield connection.topic.split("/")[1], received, message
