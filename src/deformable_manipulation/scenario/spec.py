"""What a scenario describes, as plain immutable data.

Everything is in SI units, angles in rad, quaternions x, y, z, w, vectors in the fixed frame.
The objects of this module hold checked values: they are made by
:mod:`deformable_manipulation.scenario.loader`, which reports every mistake of a file at once.
"""

import dataclasses
from dataclasses import dataclass
from typing import Optional, Tuple, Union

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.objects.object_spec import ObjectSpec

LEADER = "leader"
ASSISTANT = "assistant"

DECENTRALISED = "decentralised"
CENTRALISED = "centralised"


@dataclass(frozen=True)
class AgentSpec:
    """A robot or person that holds one particle of the object."""

    name: str
    particle: int
    role: str  # LEADER or ASSISTANT
    hold: str = "clamped"  # "clamped": keeps the particle's orientation; "pinned": leaves it free
    driven_by: str = "command"  # "command": its cmd_vel; "pose": its pose topic (a real robot)
    start: Vector = (0.0, 0.0, 0.0)  # m, held point at the start
    orientation: Quaternion = (0.0, 0.0, 0.0, 1.0)  # of the held particle at the start


@dataclass(frozen=True)
class PoseWaypoint:
    """Where an obstacle is at a time, relative to its own pose."""

    time: float  # s
    position: Vector = (0.0, 0.0, 0.0)  # m, added to the translation
    orientation: Quaternion = (0.0, 0.0, 0.0, 1.0)  # turns it about its origin, after its rotation


@dataclass(frozen=True)
class PathMotion:
    """An obstacle's scripted way; smooth between the waypoints, at rest before and after."""

    waypoints: Tuple[PoseWaypoint, ...]


@dataclass(frozen=True)
class TopicMotion:
    """An obstacle whose pose somebody publishes, as geometry_msgs/PoseStamped."""

    topic: str


@dataclass(frozen=True)
class FrameMotion:
    """An obstacle that is where a tf frame is."""

    frame: str


Motion = Union[PathMotion, TopicMotion, FrameMotion]


@dataclass(frozen=True)
class PolygonObstacle:
    """A polygon in a plane, endless along the plane's normal.

    A point (a, b) of the ring lies at ``translation + rotation * embed(a, b)``, where ``embed``
    puts a and b on the two axes that ``plane`` names ("yz": a on y, b on z).
    """

    name: str
    points: Tuple[Tuple[float, float], ...]  # m, ring; the last point need not repeat the first
    plane: str = "yz"  # "xy", "yz" or "xz"
    translation: Vector = (0.0, 0.0, 0.0)  # m
    rotation: Quaternion = (0.0, 0.0, 0.0, 1.0)
    motion: Optional[Motion] = None  # None: it stands still


@dataclass(frozen=True)
class MeshObstacle:
    """The surface of triangles in a file.

    A vertex v of the file lies at ``translation + rotation * (scale * v)``.
    """

    name: str
    mesh: str  # absolute path of a file that Trimesh reads
    translation: Vector = (0.0, 0.0, 0.0)  # m
    rotation: Quaternion = (0.0, 0.0, 0.0, 1.0)
    scale: Vector = (1.0, 1.0, 1.0)  # m per unit of the file, along the file's axes
    motion: Optional[Motion] = None  # None: it stands still


@dataclass(frozen=True)
class Waypoint:
    """Where the leader is at a time, relative to its start."""

    time: float  # s
    position: Vector  # m


@dataclass(frozen=True)
class WorkspaceSpec:
    """A box along the axes of the fixed frame."""

    lower: Vector  # m
    upper: Vector  # m


@dataclass(frozen=True)
class LeaderSpec:
    """The leader's scripted path, smooth between the waypoints, at rest before and after.

    The other keys are limits of the leader moved by hand, not of the path.
    """

    waypoints: Tuple[Waypoint, ...]
    workspace: Optional[WorkspaceSpec] = None  # None: around the path
    max_velocity: float = 0.1  # m/s, bound on every component
    max_acceleration: float = 0.25  # m/s^2, bound on every component


@dataclass(frozen=True)
class CollisionSpec:
    """Barrier that keeps the object off the obstacles (paper, eq. 3)."""

    offset: float  # m, distance to keep, from surface to surface
    alpha: Tuple[float, float] = (1.0, 5.0)  # 1/s, slopes of alpha(h) for h >= 0 and h < 0
    anticipation: Tuple[float, float] = (0.4, 5.0)  # 1/s, of the softer row beside each
    margin: float = 0.002  # m, beyond the offset, that the rows keep
    speed_margin: float = 0.0  # s, more of it per m/s of the leader's speed
    band: float = 0.1  # m, features up to this much farther than the nearest get a row of their own
    obstacle_velocity: bool = True  # of moving obstacles, in the rows
    gradient: str = "features"  # "features": each near feature; "minimum": the paper's single row
    backend: str = "native"  # of the distances; "reference": Trimesh, FCL and Shapely, slow


@dataclass(frozen=True)
class OverstretchSpec:
    """Barrier that keeps two agents from overstretching the object (paper, eq. 8)."""

    max_distance: Optional[float] = None  # m between held points; None: a fraction of their
    fraction: float = 0.99  # free length
    margin: float = 0.005  # m, by which the rows stay within it
    alpha: Tuple[float, float] = (1.0, 2.0)  # 1/s


@dataclass(frozen=True)
class ProximitySpec:
    """Barrier that keeps two agents apart (paper, eq. 11)."""

    min_distance: Optional[float] = None  # m between held points; None: 10 % of the free length
    margin: float = 0.0  # m, by which the rows stay beyond it
    alpha: Tuple[float, float] = (1.0, 2.0)  # 1/s


@dataclass(frozen=True)
class ControllerSpec:
    """The assistants' safe velocity controller."""

    collision: CollisionSpec
    overstretch: OverstretchSpec = OverstretchSpec()
    proximity: ProximitySpec = ProximitySpec()
    formulation: str = "full"  # "full", or "paper": its equations as they are
    # "decentralised": each assistant on its own; "centralised": all in one quadratic program
    cooperation: str = DECENTRALISED
    priority: Tuple[str, str, str] = ("collision", "overstretch", "proximity")  # last yields first
    rate: float = 100.0  # Hz, cycles per second
    gain: float = 1.0  # 1/s, k_p
    weights: Vector = (1.0, 1.0, 1.0)  # gamma, cost of departing from the nominal velocity per axis
    max_velocity: float = 0.15  # m/s, bound on every component
    max_acceleration: float = 1.0  # m/s^2, bound on every component
    smoothing: float = 0.2  # s, time constant of departures from the nominal velocity; 0: none
    perturbation: Vector = (0.1, 0.1, 0.1)  # m, displacement of each axis' copy
    jacobian: str = "equilibrium"  # exact gradients where known; or "perturbed_copies"
    differences: str = "central"  # "central": copies on both sides; "forward": on one (the paper)
    feedforward: bool = True  # leader's velocity in the nominal law and in the rows
    solver: str = "native"  # of the quadratic program; others: those of qpsolvers
    timeout: float = 0.2  # s, age at which an input counts as lost
    pose_smoothing: float = 0.2  # s, time constant of the filter of measured poses


@dataclass(frozen=True)
class SimulationSpec:
    """How the object is simulated and for how long."""

    duration: float  # s
    time_step: float = 0.01  # s; a whole number of them makes one controller cycle
    substeps: int = 2  # per time step
    solver: str = "direct"  # of a rod's joints: "direct" or "gauss_seidel" (needs many substeps)
    gravity: Vector = (0.0, 0.0, -9.81)  # m/s^2
    record_rate: float = 10.0  # Hz, frames in states.npz


@dataclass(frozen=True)
class KnowledgeSpec:
    """What the controllers do not know exactly, in runs without ROS; the defaults are all of it."""

    pose_noise: float = 0.0  # m, standard deviation per component, cycle and agent, white
    pose_delay: float = 0.0  # s, age of the newest poses
    stiffness_factor: float = 1.0  # of the object, true over assumed
    density_factor: float = 1.0  # true over assumed
    dropped_cycles: float = 0.0  # probability that a controller gets no new state in a cycle
    seed: int = 0  # of noise and drops

    @property
    def perfect(self) -> bool:
        """Whether the controllers see the object itself, at once and in every cycle."""
        return dataclasses.replace(self, seed=0) == KnowledgeSpec()


@dataclass(frozen=True)
class Scenario:
    """A whole run: object, agents, obstacles, leader, controller, simulation."""

    name: str
    object: ObjectSpec
    agents: Tuple[AgentSpec, ...]  # in the file's order; exactly one leader
    obstacles: Tuple[Union[PolygonObstacle, MeshObstacle], ...]
    leader: LeaderSpec
    controller: ControllerSpec
    simulation: SimulationSpec
    knowledge: KnowledgeSpec = KnowledgeSpec()
    frame: str = "map"  # the fixed frame

    @property
    def leader_index(self) -> int:
        """Index of the leader in ``agents``."""
        return next(i for i, agent in enumerate(self.agents) if agent.role == LEADER)

    @property
    def assistants(self) -> Tuple[int, ...]:
        """Indices of the assistants in ``agents``."""
        return tuple(i for i, agent in enumerate(self.agents) if agent.role == ASSISTANT)

    @property
    def cycle_time(self) -> float:
        """Seconds per controller cycle."""
        return 1.0 / self.controller.rate

    @property
    def steps_per_cycle(self) -> int:
        """Simulation time steps per controller cycle."""
        return round(self.cycle_time / self.simulation.time_step)

    @property
    def cycles(self) -> int:
        """Controller cycles in the whole run."""
        return round(self.simulation.duration * self.controller.rate)
