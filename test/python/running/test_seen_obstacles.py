"""Runs over obstacles as a robot sees them keep the limit, and not without the safety filter."""

import dataclasses

import numpy as np
import pytest
from octomap_writing import Tree, bt

from deformable_manipulation.obstacles.primitives import (
    Capsule,
    CapsuleObstacle,
    HalfSpace,
    HalfSpaceObstacle,
)
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.spec import CloudObstacle, FieldObstacle, VoxelObstacle

PLACE = np.array((0.0, 0.75, 0.7))  # m, of a log across the rope's way
RADIUS, LENGTH = 0.15, 0.6  # m
PATH = "[{time: 0, position: [0, 0, 0]}, {time: 8, position: [0, 0.1, -0.35]}]"  # down to the log
DURATION = 10.0  # s


def log(name="log"):
    """Across the rope, which is in the plane of y and z."""
    turned = (0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5))
    return CapsuleObstacle(name, Capsule(RADIUS, LENGTH), tuple(PLACE), turned)


def to_axis(points):
    """Distances of points (..., 3) from the log's axis."""
    arms = points - PLACE
    arms = arms - np.clip(arms[..., :1], -0.5 * LENGTH, 0.5 * LENGTH) * (1.0, 0.0, 0.0)
    return np.linalg.norm(arms, axis=-1)


def grid(spacing, margin=0.3):
    lines = [
        np.arange(centre - half - margin, centre + half + margin, spacing)
        for centre, half in zip(PLACE, (0.5 * LENGTH + RADIUS, RADIUS, RADIUS))
    ]
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1), [line[0] for line in lines]


def as_cloud(folder):
    points = grid(0.01)[0].reshape(-1, 3)
    points = points[np.abs(to_axis(points) - RADIUS + 0.008) < 0.006]
    np.save(folder / "log.npy", points)
    return CloudObstacle("cloud", str(folder / "log.npy"), 0.007)


def as_voxels(folder):
    tree, size = Tree(), 0.02
    for cell in np.unique(np.floor(grid(size)[0] / size).astype(int).reshape(-1, 3), axis=0):
        tree.set(cell.tolist(), bool(to_axis(size * (cell + 0.5)) < RADIUS - 0.01))
    (folder / "log.bt").write_bytes(bt(tree, size))
    return VoxelObstacle("voxels", str(folder / "log.bt"), "free")


def as_field(folder):
    places, origin = grid(0.02)
    np.savez(folder / "log.npz", distances=to_axis(places) - RADIUS, origin=origin, spacing=0.02)
    return FieldObstacle("field", str(folder / "log.npz"), "free")


KINDS = {"capsule": lambda _: log(), "cloud": as_cloud, "voxels": as_voxels, "field": as_field}


def lowest(obstacles, safety=True):
    """The least distances [m] of a run from its obstacles, and from the log itself."""
    overrides = [("simulation.duration", str(DURATION)), ("leader.waypoints", PATH)]
    scenario = load_scenario("rope_one_assistant", overrides)
    loop = ClosedLoop(dataclasses.replace(scenario, obstacles=obstacles), safety=safety)
    records = [loop.step() for _ in range(scenario.cycles)]
    true = min(to_axis(record.points).min() for record in records) - RADIUS
    return min(record.distance for record in records), true - scenario.object.radius, scenario


@pytest.mark.parametrize("kind", KINDS)
def test_the_rope_keeps_its_distance(kind, tmp_path):
    seen, true, scenario = lowest((KINDS[kind](tmp_path),))
    limit = scenario.controller.collision.offset
    assert seen > limit - 1e-4
    assert true > limit - 0.02  # what is seen of the log differs from it by as much


def test_without_the_safety_filter_it_does_not():
    assert lowest((log(),), safety=False)[0] < 0.0


def test_several_obstacles_at_once():
    floor = HalfSpaceObstacle("floor", HalfSpace(), (0.0, 0.0, 0.2))
    seen, true, scenario = lowest((floor, log()))
    assert seen > scenario.controller.collision.offset - 1e-4
