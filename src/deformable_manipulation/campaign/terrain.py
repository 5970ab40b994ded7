"""Random obstacles in place of a scenario's own ones."""

import dataclasses
import math
from functools import singledispatch
from typing import Dict, Sequence, Tuple, TypeVar

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.scenario.spec import MeshObstacle, ObstacleSpec, PolygonObstacle

_POINTS = 84  # of the surface of random hills
_WAVES = 6
_WAVELENGTHS = (0.8, 3.0)  # m
_SHIFT = 0.2  # m, of an obstacle along the level axes
_SIZES = (0.7, 1.3)  # of a mesh, in multiples of its own


_Spec = TypeVar("_Spec", bound=ObstacleSpec)


def random_obstacles(
    obstacles: Sequence[ObstacleSpec], random: np.random.Generator
) -> Tuple[ObstacleSpec, ...]:
    """Each obstacle changed by itself; a map and what it is of are moved as one."""
    mapped = [each for each in obstacles if not each.known or not (each.real or each.is_live)]
    if all(each.real for each in mapped):
        mapped = []  # there is no map: cameras see what is not known wherever it is
    moved: Dict[str, ObstacleSpec] = {}
    if mapped:
        moved = dict(zip((each.name for each in mapped), _moved_as_one(mapped, random)))
    return tuple(moved.get(each.name) or random_obstacle(each, random) for each in obstacles)


def _moved_as_one(
    obstacles: Sequence[ObstacleSpec], random: np.random.Generator
) -> Tuple[ObstacleSpec, ...]:
    """The obstacles shifted along the level axes, and turned about their midst."""
    shift, turn = _random_move(random)
    midst = np.mean([each.translation for each in obstacles if each.real], axis=0)

    def place(translation: Vector) -> Vector:
        x, y, z = np.subtract(translation, midst).tolist()
        x, y, z = (midst + rotate(turn, (x, y, z)) + shift).tolist()
        return x, y, z

    return tuple(
        each.at(place(each.translation), _product(turn, each.rotation)) for each in obstacles
    )


@singledispatch
def random_obstacle(obstacle: ObstacleSpec, random: np.random.Generator) -> ObstacleSpec:
    """An obstacle of the same kind and of about the same size, in about the same place."""
    return _moved(obstacle, random)


def _moved(obstacle: _Spec, random: np.random.Generator) -> _Spec:
    """The obstacle moved along the level axes and turned about the upright one."""
    shift, turn = _random_move(random)
    place = tuple((np.array(obstacle.translation) + shift).tolist())
    return obstacle.at(place, _product(turn, obstacle.rotation))


def _random_move(random: np.random.Generator) -> Tuple[np.ndarray, Quaternion]:
    """A shift (3,) [m] along the level axes, and a turn about the upright one."""
    shift = np.append(random.uniform(-_SHIFT, _SHIFT, 2), 0.0)
    half = 0.5 * random.uniform(-math.pi, math.pi)
    return shift, (0.0, 0.0, math.sin(half), math.cos(half))


def _product(turn: Quaternion, rotation: Quaternion) -> Quaternion:
    """A turn about the upright axis after a rotation."""
    _, _, sine, cosine = turn
    x, y, z, w = rotation
    return (
        cosine * x - sine * y,
        cosine * y + sine * x,
        cosine * z + sine * w,
        cosine * w - sine * z,
    )


@random_obstacle.register
def _hills(obstacle: PolygonObstacle, random: np.random.Generator) -> PolygonObstacle:
    """Hills between the lowest and highest point of the polygon's upper side.

    The surface is a sum of sines of random wavelengths, phases and heights; the ground below is as
    deep as that of the polygon.
    """
    ring = np.concatenate([np.array(ring) for ring in obstacle.rings])
    left, deep = ring.min(axis=0)
    right = ring[:, 0].max()
    surface = ring[ring[:, 1] > deep + 0.5 * (ring[:, 1].max() - deep), 1]
    along = np.linspace(left, right, _POINTS)
    lengths = random.uniform(*_WAVELENGTHS, _WAVES)
    waves = random.uniform(0.3, 1.0, _WAVES)[:, None] * np.sin(
        2.0 * math.pi * (along / lengths[:, None] + random.uniform(size=(_WAVES, 1)))
    )
    heights = waves.sum(axis=0)
    heights = (heights - heights.min()) / np.ptp(heights)
    heights = surface.min() + heights * np.ptp(surface) * random.uniform(0.6, 1.0)
    points = [*zip(along.tolist(), heights.tolist()), (right, deep), (left, deep)]
    return dataclasses.replace(obstacle, points=tuple(map(tuple, points)))


@random_obstacle.register
def _moved_mesh(obstacle: MeshObstacle, random: np.random.Generator) -> MeshObstacle:
    """The mesh moved and turned as any obstacle, and changed in size."""
    moved = _moved(obstacle, random)
    size = random.uniform(*_SIZES)
    scale = (size * obstacle.scale[0], size * obstacle.scale[1], size * obstacle.scale[2])
    return dataclasses.replace(moved, scale=scale)
