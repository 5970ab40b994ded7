"""An RViz view in which a scenario that has none of its own can be seen."""

import copy
import math

import numpy as np

from deformable_manipulation.obstacles.spec import obstacle_corners
from deformable_manipulation.simulation.factory import make_simulation

_NEAR = 0.6  # m, obstacles are of interest so far from where the object and the agents come
_FILLED = 0.85  # of the picture's width and height
_ASIDE = 0.28  # rad, from the normal of the obstacles' plane
_BEHIND = 0.251  # m, the grid from the obstacles' plane, just behind what is drawn of them
_LARGEST_GRID = 200  # cells


def scene_bounds(scenario, points, agents):
    """The corners (2, 3) [m], lower and upper, of the object's and agents' ways and what is near.

    Args:
        scenario: with the obstacles; those parts of them that are near are added.
        points: of the object (..., 3) [m], wherever it comes.
        agents: held points (..., 3) [m], wherever they come.
    """
    shown = np.concatenate((np.reshape(points, (-1, 3)), np.reshape(agents, (-1, 3))))
    low, high = shown.min(axis=0), shown.max(axis=0)
    bounds = [low, high]
    for obstacle in scenario.obstacles:
        if obstacle.is_live:
            continue  # nobody knows yet where it is
        corners = obstacle_corners(obstacle)
        near_low = np.maximum(corners.min(axis=0), low - _NEAR)
        near_high = np.minimum(corners.max(axis=0), high + _NEAR)
        if (near_low <= near_high).all():
            bounds += [near_low, near_high]
    return np.array([np.min(bounds, axis=0), np.max(bounds, axis=0)])


def planned_bounds(scenario):
    """The same for a scenario that has not been run, from its start and the leader's path."""
    path = np.array([waypoint.position for waypoint in scenario.leader.waypoints])
    points = make_simulation(scenario).points()[0]
    agents = np.array([agent.start for agent in scenario.agents])
    return scene_bounds(scenario, points + path[:, None], agents + path[:, None])


def plane_of(scenario):
    """The plane of the first planar obstacle, such as ``yz``; None: there is none."""
    planes = [obstacle.plane for obstacle in scenario.obstacles if obstacle.plane]
    return planes[0] if planes else None


def fitted(configuration, bounds, size, plane=None):
    """A copy of an RViz configuration, as of YAML, whose view and grids fit what is to be seen.

    Args:
        configuration: whose present view is an Orbit or a TopDownOrtho.
        bounds: (2, 3) [m], lower and upper corner.
        size: of the picture, width and height in pixels.
        plane: of planar obstacles, ``yz`` or ``xz``, which the view named Perspective looks at;
            another: it keeps its direction.

    Raises:
        KeyError, TypeError: it is no configuration of RViz.
    """
    result = copy.deepcopy(configuration)
    manager = result["Visualization Manager"]
    view = manager["Views"]["Current"] = dict(manager["Views"]["Current"])
    center = np.mean(bounds, axis=0)
    if view["Class"] == "rviz/Orbit":
        if plane == "xz" and view["Name"] == "Perspective":
            view["Yaw"] = 1.5 * math.pi - _ASIDE
        _fit_orbit(view, bounds, size)
    elif view["Class"] == "rviz/TopDownOrtho":
        _fit_top_down(view, bounds, size)
    for display in manager["Displays"]:
        if display["Class"] == "rviz/Grid":
            _fit_grid(display, center, np.ptp(bounds, axis=0), plane)
    return result


def _fit_orbit(view, bounds, size):
    center = np.mean(bounds, axis=0)
    pitch, yaw = view["Pitch"], view["Yaw"]
    to_camera = np.array(
        [math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), math.sin(pitch)]
    )
    right = np.array([-math.sin(yaw), math.cos(yaw), 0.0])
    up = np.cross(to_camera, right)
    half_height = _FILLED * math.tan(0.5 * view["Field of View"])
    half_width = half_height * size[0] / size[1]
    corners = np.stack(np.meshgrid(*np.transpose(bounds)), axis=-1).reshape(-1, 3) - center
    # A corner at the depth t behind the focal point is seen where |x| <= half_width (distance + t).
    wanted = np.maximum(np.abs(corners @ right) / half_width, np.abs(corners @ up) / half_height)
    view["Distance"] = float(np.max(wanted + corners @ to_camera))
    view["Focal Point"] = dict(zip("XYZ", center.tolist()))


def _fit_top_down(view, bounds, size):
    center, (x, y, _) = np.mean(bounds, axis=0), np.ptp(bounds, axis=0)
    sine, cosine = abs(math.sin(view["Angle"])), abs(math.cos(view["Angle"]))
    across, up = x * cosine + y * sine, x * sine + y * cosine
    view["Scale"] = float(_FILLED * min(size[0] / across, size[1] / up))  # pixels per m
    view["X"], view["Y"] = center[:2].tolist()


def _fit_grid(grid, center, extent, plane):
    """As large as the scene and more, behind it or, without a plane, where it is."""
    offset = dict(zip("XYZ", center.tolist()))
    if plane == "xz":
        grid["Plane"] = "XZ"
        offset["Y"] += _BEHIND
    elif plane == "yz":
        offset["X"] -= _BEHIND
    else:
        offset["Z"] = grid["Offset"]["Z"]
    cells = 4.0 * float(np.linalg.norm(extent)) / grid["Cell Size"]
    cells = min(max(grid["Plane Cell Count"], cells), _LARGEST_GRID)
    grid["Plane Cell Count"] = int(cells) // 2 * 2
    grid["Offset"] = offset
