"""The rod in pyPBD: its direct position-based solver for stiff rods (Deul et al. 2018)."""

import numpy as np
import pypbd

from deformable_manipulation.benchmarks.rivals.pypbd_stepper import Stepper
from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase
from deformable_manipulation.benchmarks.rod_model import RodModel, UndampedRodModel

TIME_STEP = 0.005  # s, that of the library's own demonstration of stiff rods


def make(case: RodCase, iterations: int) -> RodModel:
    """The rod of a case."""
    return PyPbdRod(case, iterations)


class PyPbdRod(UndampedRodModel):
    """Rigid bodies, and one constraint for the whole chain.

    The chain's tree has one root, so a rope whose ends are held gets a ball joint at the middle of
    its first and of its last body, each to a static body; iterations alternate between joints and
    chain.
    """

    time_step = TIME_STEP

    def __init__(self, case: RodCase, iterations: int):
        self.settings = f"direct solver for rods, iterations: {iterations}"
        self._length = case.segment_length
        self._rope = case.load == ROPE
        self._stepper = Stepper(TIME_STEP, iterations)
        self._model = self._stepper.model
        self._mesh = _cube()
        self._bodies = self._make_chain(case)
        self._hold(case)

    def _make_chain(self, case: RodCase) -> list:
        count, mass = case.segments, case.segment_mass
        axial = 0.5 * mass * case.radius**2
        across = mass / 12.0 * (3.0 * case.radius**2 + self._length**2)
        bodies = [
            self._add_body(index * self._length, mass, [axial, across, across])
            for index in range(count)
        ]
        joints = count - 1
        self._model.addDirectPositionBasedSolverForStiffRodsConstraint(
            [(index, index + 1) for index in range(joints)],
            [[(index + 0.5) * self._length, 0.0, 0.0] for index in range(joints)],
            [case.radius] * joints,
            [self._length] * joints,
            [case.young_modulus] * joints,
            [case.torsion_modulus] * joints,
        )
        return bodies

    def _hold(self, case: RodCase) -> None:
        last = case.segments - 1
        if not self._rope:
            self._bodies[0].setMass(0.0)
            self._arcs = self._length * (np.arange(case.segments) + 0.5)
            self.free_length = float(self._arcs[-1])
            return
        self._arcs = self._length * np.arange(case.segments)
        self.free_length = float(self._arcs[-1])
        self.overhang = 0.5 * self._length
        for index in (0, last):
            self._anchor = self._add_body(self._arcs[index], 0.0, [1.0, 1.0, 1.0])
            bodies = len(self._model.getRigidBodies())
            self._model.addBallJoint(bodies - 1, index, [self._arcs[index], 0.0, 0.0])

    def _add_body(self, x: float, mass: float, inertia: list):
        place, scale = [x, 0.0, 0.0], [1e-3, 1e-3, 1e-3]
        body = self._model.addRigidBody(1.0, *self._mesh, place, np.eye(3), scale, False)
        # Once more: a density and a mesh would give the mass and inertia of the mesh.
        body.initBody(mass, place, inertia, [0.0, 0.0, 0.0, 1.0], *self._mesh, scale)
        return body

    def advance(self, count: int) -> None:
        self._stepper.advance(count)

    def damp(self, factor: float) -> None:
        for body in self._bodies:
            if body.getMass() > 0.0:
                body.setVelocity(factor * body.getVelocity())
                body.setAngularVelocity(factor * body.getAngularVelocity())

    def place_end(self, x: float, velocity: float) -> None:
        place = [x, 0.0, 0.0]
        self._anchor.setPosition(place)
        self._anchor.setOldPosition(place)
        self._anchor.setLastPosition(place)

    def points(self) -> np.ndarray:
        centres = np.array([body.getPosition()[:2] for body in self._bodies])
        if self._rope:
            return centres
        along = np.array([_tangent(body.getRotation())[:2] for body in self._bodies])
        return centres + 0.5 * self._length * along

    def arc_lengths(self) -> np.ndarray:
        return self._arcs


def _tangent(rotation: np.ndarray) -> np.ndarray:
    """The x axis turned by a quaternion x, y, z, w."""
    x, y, z, w = rotation
    return np.array([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)])


def _cube():
    """A mesh, which every body must have: it is not used without collisions."""
    vertices, mesh = pypbd.VertexData(), pypbd.IndexedFaceMesh()
    for corner in range(8):
        vertices.addVertex([(corner >> axis & 1) - 0.5 for axis in (2, 1, 0)])
    faces = (
        (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
        (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
    )  # fmt: skip
    mesh.initMesh(8, 3 * len(faces), len(faces))
    for face in faces:
        mesh.addFace(face)
    mesh.buildNeighbors()
    return vertices, mesh
