"""Recordings that the package makes itself."""

import dataclasses

import numpy as np

from deformable_manipulation.objects.body import make_body
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes

ROPE = RodSpec(
    length=1.0,
    radius=0.004,
    density=1000.0,
    segments=20,
    young_modulus=2e7,
    torsion_modulus=7e6,
    damping=0.0,
    bending_retardation_time=0.05,
)
STEP = 0.01  # s
SUBSTEPS = 2
OBJECT = """object:
  type: rod
  length: 1.0
  radius: 0.004
  density: 1000.0
  segments: 20
  young_modulus: 2.0e+7
  torsion_modulus: 7.0e+6
  damping: 0.0
  bending_retardation_time: 0.05
"""


def record(spec=ROPE, frames=150, still=30, noise=0.0, seed=1):
    """A rope that is at rest, then swung by its second grip.

    The grips hold the first and the last segment. Points are the ends of both held segments and
    some between. The grips keep to a plane when they turn: their roll is not in the recording.
    """
    body = make_body(spec)
    last = spec.segments - 1
    upright = (0.0, 0.0, 0.0, 1.0)
    body.hold(0, "clamped", (0.0, 0.0, 0.0), upright)
    body.hold(last, "clamped", (0.7, 0.0, 0.0), upright)
    body.lay_out()
    body.settle(STEP, SUBSTEPS, 1e-6)
    ends = [0, 1, 4, 7, 10, 13, 16, last, last + 1]
    shapes = [body.points()[0, ends]]
    for frame in range(1, frames):
        t = STEP * max(0, frame - still)
        body.set_velocity(
            last,
            (0.4 * np.sin(4.0 * t), 0.5 * np.sin(5.0 * t), 0.3 * np.sin(6.0 * t)),
            (0.0, 1.5 * np.sin(5.0 * t), 0.0),
        )
        body.step(STEP, SUBSTEPS)
        shapes.append(body.points()[0, ends])
    points = np.array(shapes)
    points += noise * np.random.default_rng(seed).standard_normal(points.shape)
    arc_lengths = np.array(spec.arc_lengths)[ends]
    return MeasuredShapes(STEP * np.arange(frames), arc_lengths, points)


def stiffer(spec, factor):
    return dataclasses.replace(spec, young_modulus=factor * spec.young_modulus)
