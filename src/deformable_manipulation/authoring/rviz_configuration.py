"""The RViz configuration of a scenario, with views that hold all of its run."""

import copy
import math

import numpy as np
import yaml

_WINDOW = (1280, 800)  # pixels
_FAR = 40.0  # m, from which parallel lines stay parallel
_CELL = 0.5  # m, of the grid
_BEHIND = 0.3  # m, of the grid behind a flat scene: behind the obstacles as they are drawn
_FLAT = 0.1  # of the scene's width
_LEFT_OUT, _USED = "214; 39; 40", "60; 120; 90"  # red, green, blue
_SAG = 0.6  # m, what the object hangs below the agents, about
_ONTO = 0.75  # rad
_PERSPECTIVE = 0.785  # rad, field of view

# As RViz saves it; without it the panels would not stay hidden.
_HIDDEN_PANELS = (
    "000000ff00000000fd000000010000000000000156000002c5fc0200000002fb000000100044006900730070006c00"
    "6100790073000000003e000001aa000000cb00fffffffb0000000a0056006900650077007300000001ee0000011500"
    "0000a500ffffff00000500000002c500000004000000040000000800000008fc0000000100000002000000010000"
    "000a0054006f006f006c00730100000000ffffffff0000000000000000"
)


def rviz_configuration_text(scenario):
    """The configuration of :func:`rviz_configuration` as the text of an .rviz file."""
    heading = f"# Made by scripts/rviz_configuration {scenario.name}\n"
    return heading + yaml.safe_dump(
        rviz_configuration(scenario), sort_keys=False, default_flow_style=False, width=1000
    )


def rviz_configuration(scenario):
    """What an .rviz file holds: displays, tools and the views Perspective, YZ and XY.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
    """
    low, high = _scene(scenario)
    seen = any(obstacle.is_live for obstacle in scenario.obstacles)
    # What is in front of the scene may be as high as it.
    pitch = _ONTO if seen else None
    displays = [*_displays(scenario), *_clouds(scenario)]
    return configuration_around(low, high, scenario.frame, displays, pitch)


def configuration_around(low, high, frame, displays=(), pitch=None):
    """The same for what happens between two corners (3,) [m].

    Args:
        frame: the fixed one.
        displays: beside the grid, as of YAML; none: the markers on ``markers``.
        pitch: of the perspective [rad]; None: the usual one.
    """
    flat = high[0] - low[0] < _FLAT * (high[1] - low[1])  # all goes on in the plane YZ
    perspective = _perspective(low, high, flat)
    if pitch is not None:
        perspective["Pitch"] = pitch
    return {
        "Panels": [
            {"Class": "rviz/Displays", "Name": "Displays", "Splitter Ratio": 0.5},
            {"Class": "rviz/Views", "Name": "Views", "Splitter Ratio": 0.5},
        ],
        "Visualization Manager": {
            "Class": "",
            "Displays": [_grid(low, high, flat), *(displays or _DISPLAYS[:1])],
            "Enabled": True,
            "Global Options": {
                "Background Color": "250; 250; 250",
                "Default Light": True,
                "Fixed Frame": frame,
                "Frame Rate": 30,
            },
            "Name": "root",
            "Tools": _TOOLS,
            "Value": True,
            "Views": {
                "Current": perspective,
                "Saved": [copy.deepcopy(perspective), _side_view(low, high), _top_view(low, high)],
            },
        },
        "Window Geometry": {
            "Displays": {"collapsed": True},
            "Width": _WINDOW[0],
            "Height": _WINDOW[1],
            "Hide Left Dock": True,
            "Hide Right Dock": True,
            "QMainWindow State": _HIDDEN_PANELS,
            "Views": {"collapsed": True},
        },
    }


_DISPLAYS = (
    {
        "Class": "rviz/MarkerArray",
        "Name": "Run",
        "Enabled": True,
        "Marker Topic": "markers",
        "Queue Size": 100,
        "Namespaces": {},
        "Value": True,
    },
    {
        "Class": "rviz/InteractiveMarkers",
        "Name": "Drag by hand",
        "Enabled": True,
        "Enable Transparency": True,
        "Show Axes": False,
        "Show Descriptions": False,
        "Show Visual Aids": False,
        "Update Topic": "interactive_markers/update",
        "Value": True,
    },
    {
        "Class": "rviz/TF",
        "Name": "Frames of the agents",
        "Enabled": False,
        "Marker Scale": 0.8,  # of 0.2 m: longer than the balls at the grips
        "Show Arrows": False,
        "Show Names": False,
        "Value": False,
    },
)


def _displays(scenario):
    """With the axes of the grips, where these turn; without those of the fixed frame."""
    turns = scenario.controller.turns
    frames = {scenario.frame: {"Value": False}}
    return [*_DISPLAYS[:-1], {**_DISPLAYS[-1], "Enabled": turns, "Frames": frames, "Value": turns}]


# The first is the one in the hand: it drags markers, and moves the camera elsewhere.
_TOOLS = [
    {"Class": "rviz/Interact", "Hide Inactive Objects": False},
    {"Class": "rviz/MoveCamera"},
    {"Class": "rviz/Select"},
    {"Class": "rviz/FocusCamera"},
    {"Class": "rviz/Measure"},
]


def _clouds(scenario):
    """Data of live obstacles: all of them, and over them those that are not left out."""
    for topic in dict.fromkeys(each.topic for each in scenario.obstacles if each.is_live):
        yield _points("Seen on " + topic, topic, _LEFT_OUT, 2)
        yield _points("Used of it", topic + "/used", _USED, 3)


def _points(name, topic, color, size):
    return {
        "Class": "rviz/PointCloud2",
        "Name": name,
        "Enabled": True,
        "Topic": topic,
        "Color": color,
        "Color Transformer": "FlatColor",
        "Position Transformer": "XYZ",
        "Style": "Points",  # drawn fast, by the ten thousand
        "Size (Pixels)": size,
        "Decay Time": 0,
        "Queue Size": 2,
        "Value": True,
    }


def _scene(scenario):
    """Corners (3,) [m] of the box of all places where agents and moving obstacles are to be.

    What hangs below them and the way that assistants may go up are in it.
    """
    starts = np.array([agent.start for agent in scenario.agents])
    path = np.array([waypoint.position for waypoint in scenario.leader.waypoints])
    agents = np.concatenate([starts + shift for shift in path])
    obstacles = [_places_of(each) for each in scenario.obstacles if each.is_around_origin]
    places = np.concatenate([agents, agents - (0.0, 0.0, _SAG), *obstacles])
    low, high = places.min(axis=0), places.max(axis=0)
    if any(obstacle.motion is not None for obstacle in scenario.obstacles):
        high[2] += _SAG
    return low, high


def _places_of(obstacle):
    """Where the origin of an obstacle is to be (N, 3) [m]."""
    shifts = [waypoint.position for waypoint in getattr(obstacle.motion, "waypoints", ())]
    return obstacle.translation + np.array(shifts or [(0.0, 0.0, 0.0)])


def _grid(low, high, flat):
    centre = _CELL * np.round(0.5 * (low + high) / _CELL)
    size = max(high - low)
    offset = (-_BEHIND, centre[1], centre[2]) if flat else (centre[0], centre[1], 0.0)
    return {
        "Class": "rviz/Grid",
        "Name": "Grid of 0.5 m " + ("behind the scene" if flat else "on the ground"),
        "Enabled": True,
        "Plane": "YZ" if flat else "XY",
        "Cell Size": _CELL,
        "Plane Cell Count": 2 * math.ceil(1.8 * size / _CELL),
        "Color": "170; 170; 170",
        "Alpha": 0.5,
        "Offset": _point(offset),
        "Reference Frame": "<Fixed Frame>",
        "Value": True,
    }


def _perspective(low, high, flat):
    if flat:
        distance = max(1.23 * (high[1] - low[1]), 1.55 * (high[2] - low[2]))
        pitch, yaw = 0.3, 6.0
    else:
        distance, pitch, yaw = 1.05 * math.hypot(*(high - low)), 0.35, 5.6
    return _orbit("Perspective", 0.5 * (low + high), distance, pitch, yaw, _PERSPECTIVE)


def _side_view(low, high):
    height = max(0.9 * (high[1] - low[1]), 1.35 * (high[2] - low[2]))
    field = 2.0 * math.atan(0.5 * height / _FAR)
    return _orbit("YZ", 0.5 * (low + high), _FAR, 0.0, 0.0, field)


def _orbit(name, centre, distance, pitch, yaw, field_of_view):
    return {
        "Class": "rviz/Orbit",
        "Name": name,
        "Distance": round(float(distance), 2),
        "Field of View": round(field_of_view, 4),
        "Focal Point": _point(centre),
        "Near Clip Distance": 0.01,
        "Pitch": pitch,
        "Target Frame": "<Fixed Frame>",
        "Yaw": yaw,
    }


def _top_view(low, high):
    x, y = 0.5 * (low + high)[:2]
    # Along the picture's width y, as in the side view.
    scale = 0.65 * min(_WINDOW[0] / (high[1] - low[1] + 0.5), _WINDOW[1] / (high[0] - low[0] + 0.5))
    return {
        "Class": "rviz/TopDownOrtho",
        "Name": "XY",
        "Angle": 1.5708,
        "Near Clip Distance": 0.01,
        "Scale": round(float(scale)),
        "Target Frame": "<Fixed Frame>",
        "X": round(float(x), 2),
        "Y": round(float(y), 2),
    }


def _point(position):
    return {axis: round(float(value), 3) for axis, value in zip("XYZ", position)}
