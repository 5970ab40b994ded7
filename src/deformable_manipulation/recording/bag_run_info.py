"""What a bag says about its run: the topic ``run_info``."""

from typing import Any, List

import yaml
from rosbags.interfaces import Connection
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore

TOPIC = "run_info"
_STRING = "std_msgs/msg/String"


def read_run_info(reader: Reader, namespace: str = "") -> Any:
    """The content of the first ``run_info``, as of YAML; None: there is none.

    Raises:
        yaml.YAMLError: it is no YAML; and what rosbags raises on damaged data.
    """
    connections = [
        connection
        for connection in connections_of(reader, _STRING, namespace)
        if name_of(connection.topic) == TOPIC
    ]
    types: Any = get_typestore(Stores.ROS1_NOETIC)
    for _, _, data in reader.messages(connections) if connections else ():
        return yaml.safe_load(types.deserialize_ros1(data, _STRING).data)
    return None


def connections_of(reader: Reader, msgtype: str, namespace: str) -> List[Connection]:
    """Those of a type within a namespace; where there are none, all of the type.

    Topics that were recorded by relative names do not include their namespace.
    """
    every = [connection for connection in reader.connections if connection.msgtype == msgtype]
    return [each for each in every if namespace_of(each.topic) == namespace] or every


def namespace_of(topic: str) -> str:
    """What stands before the last part of a topic's name, such as ``/left``."""
    return topic.rpartition("/")[0]


def name_of(topic: str) -> str:
    """The last part of a topic's name."""
    return topic.rpartition("/")[2]
