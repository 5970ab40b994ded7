"""The layers of the Python package, read from its sources; imports inside functions count too."""

import ast
import re
from pathlib import Path

import pytest

import deformable_manipulation.scenario

PACKAGE = "deformable_manipulation"
# The package's own directory in the sources: in a development space its first path is another.
ROOT = Path(deformable_manipulation.scenario.__file__).resolve().parents[1]
ROOM_OF_THE_FACE = ""

ROS_PACKAGE = re.compile(
    r"ros(py|lib|graph|bag|launch|node|service|topic|param|master)|tf2?(_ros)?|genpy|genmsg|"
    r"message_filters|\w+_msgs|std_srvs|dynamic_reconfigure|interactive_markers|diagnostic_updater"
)
GENERATED = ("msg", "srv", "cfg")  # of this package, by ROS's generators


def module_name(path):
    parts = path.relative_to(ROOT.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in ROOT.rglob("*.py")}


def imported_names(source):
    """All that a module imports, at its top or in functions, as dotted names."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative import"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def nearest_module(name, modules):
    """The module that a dotted name stands for or is in; None: it is not of the package."""
    while name and name not in modules:
        name = name.rpartition(".")[0]
    return name or None


def import_graph(sources):
    """What each module imports of the others: name -> set of names."""
    return {
        name: {nearest_module(each, sources) for each in imported_names(source)} - {None, name}
        for name, source in sources.items()
    }


def room(module):
    return module.split(".")[1] if "." in module else ROOM_OF_THE_FACE


def room_graph(graph):
    rooms = {room(module): set() for module in graph}
    for module, imported in graph.items():
        rooms[room(module)] |= {room(each) for each in imported} - {room(module)}
    return rooms


def find_circle(graph):
    """One circle of a graph as a list whose ends are the same; empty where there is none."""
    finished, way = set(), []

    def visit(node):
        if node in way:
            return way[way.index(node) :] + [node]
        if node in finished:
            return []
        way.append(node)
        for following in sorted(graph.get(node, ())):
            circle = visit(following)
            if circle:
                return circle
        finished.add(way.pop())
        return []

    return next(filter(None, map(visit, sorted(graph))), [])


def uses_ros(name):
    parts = name.split(".")
    if parts[0] == PACKAGE:
        return len(parts) > 1 and parts[1] in GENERATED
    return bool(ROS_PACKAGE.fullmatch(parts[0]))


@pytest.fixture(scope="module")
def sources():
    return {name: path.read_text(encoding="utf-8") for name, path in MODULES.items()}


@pytest.fixture(scope="module")
def graph(sources):
    return import_graph(sources)


def test_the_sources_were_found(graph):
    assert f"{PACKAGE}.scenario.spec" in graph[f"{PACKAGE}.scenario.loader"]


def test_modules_import_one_another_in_no_circle(graph):
    circle = find_circle(graph)
    assert not circle, "modules import one another in a circle: " + " -> ".join(circle)


def test_rooms_import_one_another_in_no_circle(graph):
    circle = find_circle(room_graph(graph))
    assert not circle, "rooms import one another in a circle: " + " -> ".join(circle)


def test_only_commands_import_commands(graph):
    guilty = [
        f"{module} imports {each}"
        for module, imported in graph.items()
        for each in imported
        if room(each) == "commands" and room(module) != "commands"
    ]
    assert not guilty, "move what is shared out of commands/: " + "; ".join(guilty)


def test_only_ros_imports_ros(sources):
    guilty = [
        f"{module} imports {name}"
        for module, source in sources.items()
        for name in imported_names(source)
        if room(module) != "ros" and uses_ros(name)
    ]
    assert not guilty, "move what needs ROS into ros/: " + "; ".join(guilty)


def test_no_module_is_loose_at_the_root():
    loose = sorted(path.name for path in ROOT.glob("*.py") if path.name != "__init__.py")
    assert not loose, "give them a room: " + ", ".join(loose)


def test_every_room_is_a_package():
    without = {path.parent for path in MODULES.values()} - {
        path.parent for path in MODULES.values() if path.name == "__init__.py"
    }
    assert not without, f"they lack an __init__.py: {sorted(map(str, without))}"


@pytest.mark.parametrize(
    "graph, circle",
    [
        ({"a": {"b"}, "b": {"c"}, "c": set()}, []),
        ({"a": {"b"}, "b": {"c"}, "c": {"b"}}, ["b", "c", "b"]),
        ({"a": {"a"}}, ["a", "a"]),
    ],
)
def test_circles_are_found(graph, circle):
    assert find_circle(graph) == circle


def test_imports_in_functions_are_found():
    sources = {"a": "def f():\n    from a.b import c", "a.b": "import a"}
    assert import_graph(sources) == {"a": {"a.b"}, "a.b": {"a"}}


@pytest.mark.parametrize(
    "name, ros",
    [
        ("rospy.numpy_msg.numpy_msg", True),
        ("geometry_msgs.msg.Point", True),
        ("tf2_ros", True),
        (f"{PACKAGE}.msg.ObjectState", True),
        ("rosbags.rosbag1.Reader", False),
        ("rospkg", False),
        (f"{PACKAGE}.ros.node", False),
    ],
)
def test_packages_of_ros_are_told(name, ros):
    assert uses_ros(name) == ros
