"""RViz that shows nothing but its 3D view, in the size of the screen."""

import contextlib
import copy
import xmlrpc.client
from pathlib import Path

import rosgraph
import yaml

from deformable_manipulation.system.program import Program, ProgramError
from deformable_manipulation.system.text_files import TextFileError, read_text

_NODE = "/snapshot_view"
_HANDLES = "rviz/InteractiveMarkers"  # nobody drags anything in a picture
_FRAME_RATE = 10  # Hz, what is still needs no more
_MARKERS = "rviz/MarkerArray"


def read_configuration(path, view, size):
    """An RViz configuration file's content, for a bare 3D view.

    Args:
        path: the file.
        view: name of one of its saved views; None: the one that it shows.
        size: width and height in pixels.

    Returns:
        The configuration as of YAML.

    Raises:
        ProgramError: the file cannot be read or has no view of that name.
    """
    try:
        return bare_view(yaml.safe_load(read_text(path)), view, size)
    except TextFileError as error:
        raise ProgramError(f"{path} {error}") from error
    except (yaml.YAMLError, KeyError, TypeError) as error:
        raise ProgramError(f"{path} is not an RViz configuration: {error!r}") from error


def bare_view(configuration, view, size):
    """A copy of a configuration with one view filling a window of the given size, to look at.

    Raises:
        ProgramError: there is no saved view of that name.
        KeyError, TypeError: it is not the configuration of RViz.
    """
    result = copy.deepcopy(configuration)
    manager = result["Visualization Manager"]
    if view is not None:
        saved = {each["Name"]: each for each in manager["Views"].get("Saved") or []}
        if view not in saved:
            names = ", ".join(f"'{name}'" for name in saved) or "none"
            raise ProgramError(
                f"--view '{view}': there is no saved view of this name; saved: {names}"
            )
        manager["Views"]["Current"] = saved[view]
    manager["Global Options"]["Frame Rate"] = _FRAME_RATE
    manager["Displays"] = [each for each in manager["Displays"] if each["Class"] != _HANDLES]
    width, height = size
    result["Panels"] = []
    result["Window Geometry"] = {
        "X": 0,
        "Y": 0,
        "Width": width,
        "Height": height,
        "Hide Left Dock": True,
        "Hide Right Dock": True,
    }
    return result


def with_frame_rate(configuration, rate):
    """A copy of a configuration that is drawn at a rate [Hz]."""
    result = copy.deepcopy(configuration)
    result["Visualization Manager"]["Global Options"]["Frame Rate"] = rate
    return result


def without(configuration, namespaces):
    """A copy of a configuration that does not show some of the markers."""
    result = copy.deepcopy(configuration)
    for display in result["Visualization Manager"]["Displays"]:
        if display["Class"] == _MARKERS:
            display["Namespaces"] = dict.fromkeys(namespaces, False)
    return result


@contextlib.contextmanager
def rviz_view(configuration, display, directory):
    """RViz on a virtual display, for the time of a with statement.

    Args:
        configuration: an RViz configuration, as of YAML.
        display: VirtualDisplay.
        directory: existing folder for its files.

    Yields:
        RvizView

    Raises:
        ProgramError: it does not start.
    """
    path = Path(directory) / "snapshot.rviz"
    path.write_text(yaml.safe_dump(configuration), encoding="utf-8")
    environment = display.environment()
    # The user's list of recent files stays as it is.
    environment["HOME"] = environment["XDG_RUNTIME_DIR"] = str(directory)
    command = ["rviz", "--fullscreen", "--splash-screen", "", "-d", str(path)]
    command.append("__name:=" + _NODE.strip("/"))
    with Program("RViz", command, Path(directory) / "rviz.log", environment) as program:
        yield RvizView(program)


class RvizView:
    """A running RViz and what it is connected to."""

    def __init__(self, program):
        self.program = program
        self._master = rosgraph.Master("/snapshot_watch")

    def publishers(self, topic):
        """Names of the nodes that publish a topic, if RViz receives it from all of them."""
        try:
            nodes = dict(self._master.getSystemState()[0]).get(topic, [])
            addresses = {self._master.lookupNode(node) for node in nodes}
            return nodes if addresses <= self._sources(topic) else []
        except (rosgraph.MasterException, OSError, xmlrpc.client.Error):
            return []  # a node has just come or gone

    def _sources(self, topic):
        """Addresses of the nodes that it receives a topic from."""
        node = xmlrpc.client.ServerProxy(self._master.lookupNode(_NODE))
        _, _, connections = node.getBusInfo("/snapshot_watch")
        return {each[1] for each in connections if each[2] == "i" and each[4] == topic and each[5]}
