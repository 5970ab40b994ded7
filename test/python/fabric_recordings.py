"""Recordings of a sheet that the package makes itself."""

import numpy as np

from deformable_manipulation.objects.body import make_body
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.fabric_grid import grid_mesh
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes

SIZE = (0.4, 0.3)  # m
CELLS = (8, 6)
STEP = 0.01  # s
SUBSTEPS = 5
HELD = ((0,), (2,))  # measured points: both corners at y = 0
OBJECT = """object:
  type: fabric
  size: [0.4, 0.3]
  resolution: 20
  density: 0.2
  thickness: 0.001
  stretching_compliance: 0.002
  bending_compliance: 2000.0
  damping: 2.0
simulation:
  substeps: 5
"""


def sheet(bending_compliance=2000.0, damping=2.0):
    mesh = grid_mesh(SIZE, CELLS)
    return FabricSpec(
        vertices=mesh.vertices,
        triangles=mesh.triangles,
        density=0.2,
        thickness=0.001,
        stretching_compliance=0.002,
        bending_compliance=bending_compliance,
        damping=damping,
    )


def record(spec=None, frames=120, still=20, noise=0.0):
    """A sheet hangs from two corners, which are then moved; three by three points are measured."""
    spec = spec or sheet()
    body = make_body(spec)
    upright = (0.0, 0.0, 0.0, 1.0)
    corners = {0: np.array((0.0, 0.0, 1.0)), CELLS[0]: np.array((0.34, 0.0, 1.0))}
    for vertex, position in corners.items():
        body.hold(vertex, "pinned", position, upright)
    body.lay_out()
    body.settle(STEP, SUBSTEPS, 1e-6)
    width = CELLS[0] + 1
    measured = [row * width + column for row in (0, 3, 6) for column in (0, 4, 8)]
    shapes = [body.points()[0, measured]]
    for frame in range(1, frames):
        t = STEP * max(0, frame - still)
        for vertex, phase in zip(corners, (0.0, 0.5)):
            velocity = (0.0, 0.4 * np.sin(6.0 * t + phase) if t else 0.0, 0.2 * np.sin(5.0 * t))
            body.set_velocity(vertex, velocity)
        body.step(STEP, SUBSTEPS)
        shapes.append(body.points()[0, measured])
    points = np.array(shapes)
    points += noise * np.random.default_rng(1).standard_normal(points.shape)
    places = np.array(spec.vertices)[measured, :2]
    return MeasuredShapes(STEP * np.arange(frames), places, points)
