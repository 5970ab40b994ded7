"""docs/parameters.md names every key, with the default the code has."""

import dataclasses
import re

import pytest
import yaml

from deformable_manipulation.objects.fabric import FABRIC
from deformable_manipulation.objects.rod import POSE, ROD
from deformable_manipulation.scenario import package_share_directory
from deformable_manipulation.scenario.agents import AGENT
from deformable_manipulation.scenario.controller import (
    COLLISION,
    CONTROLLER,
    OVERSTRETCH,
    PROXIMITY,
)
from deformable_manipulation.scenario.knowledge import KNOWLEDGE
from deformable_manipulation.scenario.loader import SCENARIO
from deformable_manipulation.scenario.motions import MOTION, POSE_WAYPOINT
from deformable_manipulation.scenario.obstacles import MESH_OBSTACLE, POLYGON_OBSTACLE
from deformable_manipulation.scenario.simulation import SIMULATION
from deformable_manipulation.scenario.waypoints import LEADER_PATH, WAYPOINT, WORKSPACE

SECTIONS = {
    "Top level": SCENARIO,
    "object: rod": ROD,
    "object: fabric": FABRIC,
    "object.pose": POSE,
    "agents": AGENT,
    "obstacles: polygon": POLYGON_OBSTACLE,
    "obstacles: mesh": MESH_OBSTACLE,
    "obstacles: motion": MOTION,
    "obstacles: motion.waypoints": POSE_WAYPOINT,
    "leader": LEADER_PATH,
    "leader.waypoints": WAYPOINT,
    "leader.workspace": WORKSPACE,
    "controller": CONTROLLER,
    "controller.collision": COLLISION,
    "controller.overstretch": OVERSTRETCH,
    "controller.proximity": PROXIMITY,
    "simulation": SIMULATION,
    "knowledge": KNOWLEDGE,
}


@pytest.fixture(scope="module")
def tables():
    """Rows of the page: heading -> key -> cells (key, type, unit, default, allowed, meaning)."""
    text = (package_share_directory() / "docs" / "parameters.md").read_text(encoding="utf-8")
    found = {}
    for part in re.split(r"^#+ ", text, flags=re.MULTILINE)[1:]:
        heading, _, body = part.partition("\n")
        rows = [line.strip("|").split("|") for line in body.splitlines() if line[:3] == "| `"]
        cells = [[cell.strip() for cell in row] for row in rows]
        found[heading.strip()] = {row[0].strip("`"): row for row in cells}
    return found


@pytest.mark.parametrize("heading", SECTIONS)
def test_every_key_is_there_and_no_other(tables, heading):
    section = SECTIONS[heading]
    assert set(tables[heading]) == set(section.fields) | set(section.others)


@pytest.mark.parametrize("heading", SECTIONS)
def test_every_plain_default_is_the_code_s(tables, heading):
    section = SECTIONS[heading]
    for key in section.fields:
        default = section.defaults.get(key, dataclasses.MISSING)
        cell = tables[heading][key][3]
        if default is dataclasses.MISSING:
            assert not cell.startswith("`"), (key, cell)
        elif isinstance(default, (bool, int, float, str, tuple)) and default != ():
            plain = list(default) if isinstance(default, tuple) else default
            assert yaml.safe_load(cell.strip("`")) == plain, key


@pytest.mark.parametrize("heading", SECTIONS)
def test_every_unit_is_the_one_in_the_messages(tables, heading):
    for key, reader in SECTIONS[heading].fields.items():
        for unit in re.findall(r" \[([^\], ]+)\]", reader.allowed):
            assert tables[heading][key][2] == unit, key
