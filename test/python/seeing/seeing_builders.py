"""Scenarios with a camera for tests."""

import yaml

from deformable_manipulation.scenario import scenario_from_mapping

SEEN_BLOCK = """
object: {type: rod, length: 2.25, radius: 0.0035, density: 1792.89, segments: 28,
  young_modulus: 3.0e+7, torsion_modulus: 1.0e+7,
  pose: {position: [0.0, 0.0, 1.35], orientation: [0.0, 0.0, 0.70710678, 0.70710678]}}
agents:
  leader: {particle: 0, role: leader, start: [0.0, 0.0, 1.35]}
  assistant_1: {particle: 27, role: assistant, start: [0.0, 1.5, 1.35]}
obstacles:
- {name: block, box: {size: [0.3, 0.3, 0.3]}, translation: [0.0, 0.8, 0.25], known: false}
- {name: seen, live_cloud: camera/points, radius: 0.005, least_points: 100,
   leave_out: {object: 0.04, grips: 0.045}}
camera: {position: [1.4, 0.4, 1.2], target: [0.0, 0.75, 0.4], width: 120, height: 90, noise: 0.0004}
leader:
  waypoints:
  - {time: 0.0, position: [0.0, 0.0, 0.0]}
  - {time: 5.0, position: [0.0, 0.0, -0.3]}
controller: {collision: {offset: 0.05}, horizon: {leader_doubt: 0.0}}
simulation: {duration: 6.0}
"""


def seen_block(**changes):
    """A rope that is lowered onto a block, which only the camera sees.

    Args:
        changes: values by keys with __ between their parts, as in ``camera__noise=0.0``; numbers
            are items of lists.
    """
    mapping = yaml.safe_load(SEEN_BLOCK)
    for path, value in changes.items():
        *way, last = (int(key) if key.isdigit() else key for key in path.split("__"))
        section = mapping
        for key in way:
            section = section[key]
        section[last] = value
    return scenario_from_mapping(mapping, ".")
