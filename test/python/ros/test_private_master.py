"""A master of one's own, also where other programs take ports at the same time."""

import contextlib
import socket
import threading
from xmlrpc.server import SimpleXMLRPCServer

import pytest
import rosgraph

from deformable_manipulation.ros import private_master


@pytest.fixture
def keep_environment(monkeypatch):
    """The environment that a private master changes is put back."""
    for name in ("ROS_MASTER_URI", "ROS_LOG_DIR", "ROS_HOSTNAME"):
        monkeypatch.setenv(name, "")


def choose(monkeypatch, *ports):
    """The ports that are taken for free, one after the other; later ones are."""
    left, free_port = list(ports), private_master._free_port
    monkeypatch.setattr(private_master, "_free_port", lambda: left.pop(0) if left else free_port())


@contextlib.contextmanager
def serving_node():
    """The port of an XML-RPC server that is no master, such as a node's."""
    with SimpleXMLRPCServer(("localhost", 0), logRequests=False) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield server.server_address[1]
        finally:
            server.shutdown()
            thread.join()


def test_a_port_that_a_node_took(keep_environment, monkeypatch, tmp_path):
    with serving_node() as port:
        choose(monkeypatch, port)
        with private_master.private_master(tmp_path):
            assert rosgraph.Master("/test").getUri() != f"http://localhost:{port}/"
            assert rosgraph.is_master_online()


def test_a_port_that_another_master_took(keep_environment, monkeypatch, tmp_path):
    with private_master.private_master(tmp_path):
        other = rosgraph.Master("/test").getPid()
        port = int(rosgraph.Master("/test").getUri().strip("/").rpartition(":")[2])
        choose(monkeypatch, port)
        with private_master.private_master(tmp_path):
            assert rosgraph.Master("/test").getPid() != other


def test_a_port_that_something_else_took(keep_environment, monkeypatch, tmp_path):
    with socket.socket() as taken:
        taken.bind(("localhost", 0))
        choose(monkeypatch, taken.getsockname()[1])
        with private_master.private_master(tmp_path):
            assert rosgraph.is_master_online()
