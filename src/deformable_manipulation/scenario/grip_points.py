"""Where the particles of a grip are at the start."""

from typing import Dict

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.geometry.rotation import conjugate, multiply, rotate
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.scenario.agents import AgentSpec


def held_points(spec: ObjectSpec, agent: AgentSpec) -> Dict[int, Vector]:
    """Positions [m] of all particles that an agent holds at the start, in the fixed frame.

    They lie around the one at the held point as on the undeformed object, and turn with the grip.
    """
    turn = multiply(agent.orientation, conjugate(spec.particle_orientation(agent.particle)))
    centre = spec.particle_position(agent.particle)
    points = {}
    for particle in agent.particles:
        x, y, z = (p - c for p, c in zip(spec.particle_position(particle), centre))
        arm = rotate(turn, (x, y, z))
        points[particle] = tuple(s + a for s, a in zip(agent.start, arm))
    return points
