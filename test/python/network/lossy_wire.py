"""Two computers on one machine: this one and a network namespace.

They are joined by a wire that delays and loses frames and can be cut. The wire is a process of ours
between two veth pairs, so it works where the kernel has no netem.
"""

import collections
import contextlib
import random
import select
import socket
import subprocess
import threading
import time
from pathlib import Path

HERE, THERE = "10.231.77.1", "10.231.77.2"
_ETH_P_ALL = 3
_NAMESPACES = Path("/run/netns")  # which iproute2 makes a mount point, and leaves as one


def run(*command):
    subprocess.run(command, check=True, capture_output=True, text=True)


@contextlib.contextmanager
def no_mount_left():
    """Undoes what the first network namespace of a machine has mounted."""
    mounted, there = _is_mounted(_NAMESPACES), _NAMESPACES.exists()
    try:
        yield
    finally:
        if not mounted and _is_mounted(_NAMESPACES) and not any(_NAMESPACES.iterdir()):
            run("umount", str(_NAMESPACES))
            if not there:
                _NAMESPACES.rmdir()


def _is_mounted(folder):
    # os.path.ismount does not see a folder that is mounted onto itself.
    mounts = Path("/proc/self/mountinfo").read_text().splitlines()
    return any(mount.split()[4] == str(folder) for mount in mounts)


class LossyWire:
    """Carries Ethernet frames between two interfaces, each way with a delay [s] and a loss."""

    def __init__(self, first, second, delay, loss, seed=1):
        self._ends = [self._open(first), self._open(second)]
        self._delay = delay
        self._loss = loss
        self._random = random.Random(seed)
        self._under_way = collections.deque()  # (time due, end, frame), in order
        self._cut = threading.Event()
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._carry, daemon=True)
        self._thread.start()

    @staticmethod
    def _open(interface):
        end = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(_ETH_P_ALL))
        end.bind((interface, 0))
        end.setblocking(False)
        return end

    def cut(self):
        self._cut.set()

    def mend(self):
        self._cut.clear()

    def close(self):
        self._stopped.set()
        self._thread.join()
        for end in self._ends:
            end.close()

    def _carry(self):
        while not self._stopped.is_set():
            due = self._under_way[0][0] - time.monotonic() if self._under_way else 0.05
            for end in select.select(self._ends, [], [], max(0.0, due))[0]:
                self._take_in(end)
            while self._under_way and self._under_way[0][0] <= time.monotonic():
                _, end, frame = self._under_way.popleft()
                with contextlib.suppress(OSError):  # the interface is going away
                    end.send(frame)

    def _take_in(self, end):
        frame, address = end.recvfrom(65535)
        if address[2] == socket.PACKET_OUTGOING or self._cut.is_set():
            return
        if self._random.random() >= self._loss:
            other = self._ends[1 - self._ends.index(end)]
            self._under_way.append((time.monotonic() + self._delay, other, frame))


@contextlib.contextmanager
def two_computers(delay, loss, namespace="dm_other"):
    """Yields the wire between HERE and THERE, the other computer in the network namespace."""
    run("ip", "netns", "add", namespace)
    wire = None
    try:
        for end, inner, address, where in (
            ("dm_here", "dm_wire_a", HERE, ()),
            ("dm_there", "dm_wire_b", THERE, ("ip", "netns", "exec", namespace)),
        ):
            run("ip", "link", "add", end, "type", "veth", "peer", "name", inner)
            if where:
                run("ip", "link", "set", end, "netns", namespace)
            run(*where, "ip", "addr", "add", f"{address}/24", "dev", end)
            # Frames must be whole and their checksums real to pass through a user's process.
            run(*where, "ethtool", "-K", end, "tx", "off", "gso", "off", "tso", "off", "gro", "off")
            run("ethtool", "-K", inner, "tx", "off", "gso", "off", "gro", "off")
            run(*where, "ip", "link", "set", end, "up")
            run("ip", "link", "set", inner, "up")
        run("ip", "netns", "exec", namespace, "ip", "link", "set", "lo", "up")
        wire = LossyWire("dm_wire_a", "dm_wire_b", delay, loss)
        yield wire
    finally:
        if wire is not None:
            wire.close()
        for interface in ("dm_here", "dm_wire_b"):
            subprocess.run(["ip", "link", "delete", interface], capture_output=True, check=False)
        run("ip", "netns", "delete", namespace)
