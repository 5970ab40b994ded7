"""An assistant's controller on a computer of its own, over a wire that delays, loses and is cut."""

import os
import shutil
import signal
import socket
import subprocess
import threading
import time

import numpy as np
import pytest
from lossy_wire import HERE, THERE, no_mount_left, two_computers

pytest.importorskip("rospy")

DELAY = 0.01  # s, each way
LOSS = 0.005
PATIENCE = 60.0  # s, for anything that has to happen

SCENARIO_CHANGES = (
    "controller.timeout=0.3 "
    # The leader moves all the time, so that an assistant that follows does, too.
    "leader.waypoints.1.time=1 leader.waypoints.2.time=45 leader.waypoints.2.position=[0.0,2.0,0.0]"
)


def _can_make_networks():
    if os.geteuid() != 0 or not shutil.which("ip") or not shutil.which("ethtool"):
        return False
    with no_mount_left():
        tried = [
            subprocess.run(["ip", "netns", *arguments], capture_output=True, check=False).returncode
            for arguments in (
                ("add", "dm_probe"),
                ("exec", "dm_probe", "true"),  # fails in a chroot without /sys
                ("delete", "dm_probe"),
            )
        ]
    return tried == [0, 0, 0]


pytestmark = pytest.mark.skipif(
    not _can_make_networks(), reason="needs root, iproute2, ethtool and network namespaces"
)


def _free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


class Launch:
    """A roslaunch that is ended with all its nodes."""

    def __init__(self, arguments, address, port, log, prefix=()):
        environment = dict(
            os.environ, ROS_MASTER_URI=f"http://{HERE}:{port}", ROS_IP=address, PYTHONUNBUFFERED="1"
        )
        environment.pop("ROS_HOSTNAME", None)
        with open(log, "w") as output:
            self._process = subprocess.Popen(
                [*prefix, "roslaunch", *arguments],
                env=environment,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def close(self):
        os.killpg(self._process.pid, signal.SIGINT)
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()


class StateLog:
    """The world's states as they come: time, and the assistant's velocity."""

    def __init__(self):
        self.changed = threading.Condition()
        self.stamps, self.velocities, self.errors = [], [], []

    def add(self, state):
        leader, assistant = state.agents.index("leader"), state.agents.index("assistant_1")
        positions = np.reshape(state.agent_positions, (-1, 3))
        with self.changed:
            self.stamps.append(state.header.stamp.to_sec())
            self.velocities.append(
                float(np.linalg.norm(np.reshape(state.agent_velocities, (-1, 3))[assistant]))
            )
            offset = positions[assistant] - positions[leader] - (0.0, 1.5, 0.0)
            self.errors.append(float(np.linalg.norm(offset)))
            self.changed.notify_all()

    def wait(self, condition, what):
        """Until a state fulfils the condition; returns its stamp."""
        with self.changed:
            assert self.changed.wait_for(lambda: self.stamps and condition(), PATIENCE), what
            return self.stamps[-1]


def _watch(log):
    import rospy

    from deformable_manipulation.msg import ObjectState

    rospy.init_node("observer", anonymous=True, disable_signals=True)
    return rospy.Subscriber("/state", ObjectState, log.add, queue_size=100, tcp_nodelay=True)


def test_the_assistant_stops_when_the_link_is_cut_and_resumes(monkeypatch, tmp_path):
    port = _free_port()
    monkeypatch.setenv("ROS_MASTER_URI", f"http://{HERE}:{port}")
    monkeypatch.setenv("ROS_IP", HERE)
    log = StateLog()
    with no_mount_left(), two_computers(DELAY, LOSS) as wire:
        world = Launch(
            [
                "--port",
                str(port),
                "deformable_manipulation",
                "rope_one_assistant.launch",
                "rviz:=false",
                "assistants:=none",
                f"set:={SCENARIO_CHANGES}",
            ],
            HERE,
            port,
            tmp_path / "world.log",
        )
        other = None
        try:
            _await_master(port)
            other = Launch(
                [
                    "--wait",
                    "deformable_manipulation",
                    "agent.launch",
                    "agent:=assistant_1",
                    "scenario:=rope_one_assistant",
                    f"set:={SCENARIO_CHANGES}",
                ],
                THERE,
                port,
                tmp_path / "agent.log",
                prefix=("ip", "netns", "exec", "dm_other"),
            )
            _watch(log)
            log.wait(lambda: log.velocities[-1] > 0.02, "the assistant follows")
            log.wait(lambda: log.errors[-1] < 0.02, "the assistant has caught up")

            wire.cut()
            cut = log.stamps[-1]
            stopped = log.wait(lambda: log.velocities[-1] == 0.0, "the assistant stops")
            # The command that is under way, its timeout, and the cycles that notice it.
            assert stopped - cut < 0.3 + DELAY + 0.1
            still = log.wait(lambda: log.stamps[-1] > stopped + 1.0, "states go on")
            with log.changed:
                after = [v for t, v in zip(log.stamps, log.velocities) if stopped <= t <= still]
            assert max(after) == 0.0

            wire.mend()
            log.wait(lambda: log.velocities[-1] > 0.02, "the assistant resumes")
            log.wait(lambda: log.errors[-1] < 0.02, "the assistant has caught up again")
        finally:
            if other is not None:
                other.close()
            world.close()
    assert "stands still: no command" in (tmp_path / "world.log").read_text()
    assert "is lost: no pose" in (tmp_path / "agent.log").read_text()


def _await_master(port):
    import rosgraph

    deadline = time.monotonic() + PATIENCE
    while not rosgraph.is_master_online(f"http://{HERE}:{port}"):
        assert time.monotonic() < deadline, "no ROS master"
        threading.Event().wait(0.1)
