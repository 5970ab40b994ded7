#!/usr/bin/env python3
"""Messages sent in the caller's thread, with a subscriber that stands still."""

import io
import itertools
import socket
import struct
import unittest
from xmlrpc.client import ServerProxy

import rospy
from observed_run import DEADLINE, Messages, poll, run_tests
from rosgraph.network import read_ros_handshake_header, write_ros_handshake_header
from std_msgs.msg import String

from deformable_manipulation.ros.direct_publisher import DirectPublisher

SIZE = 1000  # bytes of a message
COUNT = 20000  # messages, more than fit into a connection


class Standing:
    """A subscriber of a topic of this node that reads only when it is told to."""

    def __init__(self, topic, message_class):
        topic = rospy.resolve_name(topic)
        node = ServerProxy(rospy.get_node_uri())
        _, _, (_, host, port) = node.requestTopic("/standing", topic, [["TCPROS"]])
        self._socket = socket.create_connection((host, port), DEADLINE)
        header = {"callerid": "/standing", "topic": topic}
        header.update(md5sum=message_class._md5sum, type=message_class._type)
        write_ros_handshake_header(self._socket, header)
        read_ros_handshake_header(self._socket, io.BytesIO(), 4096)
        self._stream = self._socket.makefile("rb")
        self._message_class = message_class

    def read(self):
        """The next message."""
        (size,) = struct.unpack("<I", self._stream.read(4))
        return self._message_class().deserialize(self._stream.read(size))

    def close(self):
        self._stream.close()
        self._socket.close()


class DirectPublisherTest(unittest.TestCase):
    def setUp(self):
        topic = self._testMethodName
        self.publisher = DirectPublisher(topic, String)
        self.addCleanup(self.publisher.unregister)
        self.reader = Messages(topic, String)
        self.standing = Standing(topic, String)
        self.addCleanup(self.standing.close)
        poll(lambda: self.publisher.get_num_connections() == 2, "both subscribers")

    def publish(self, number):
        self.publisher.publish(String(str(number).zfill(SIZE)))

    def test_the_others_get_messages_while_one_stands_still(self):
        for number in range(COUNT):
            self.publish(number)
        after = len(self.reader)
        numbers = itertools.count(COUNT)

        def arrives():
            self.publish(next(numbers))
            return any(int(message.data) >= COUNT for message in self.reader[after:])

        poll(arrives, "a message for who reads")

    def test_it_gets_new_messages_in_order_once_it_reads_again(self):
        for number in range(COUNT):
            self.publish(number)
        read = []
        for number in itertools.count(COUNT):
            self.publish(number)
            read.append(int(self.standing.read().data))
            if read[-1] >= COUNT:
                break
        self.assertEqual(read, sorted(set(read)))
        self.assertLess(len(read), COUNT)

    def test_who_has_gone_is_forgotten(self):
        self.standing.close()

        def forgotten():
            self.publish(0)
            return self.publisher.get_num_connections() == 1

        poll(forgotten, "the end of a connection")
        self.publish(1)
        self.reader.wait_for(lambda message: int(message.data) == 1, "a message for who reads")


if __name__ == "__main__":
    run_tests("direct_publisher")
