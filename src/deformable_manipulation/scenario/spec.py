"""What a scenario describes, as plain immutable data.

Everything is in SI units, angles in rad, quaternions x, y, z, w, vectors in the fixed frame.
The objects of this module hold checked values: they are made by
:mod:`deformable_manipulation.scenario.loader`, which reports every mistake of a file at once. Each
section's class is declared in a module of its own, with all that is to know of its keys.
"""

from dataclasses import dataclass
from typing import Optional, Tuple

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.kinds import read_object
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.obstacles.cloud import CloudObstacle
from deformable_manipulation.obstacles.field import FieldObstacle
from deformable_manipulation.obstacles.kinds import read_obstacles
from deformable_manipulation.obstacles.live import LiveObstacle
from deformable_manipulation.obstacles.live_cloud import LiveCloudObstacle
from deformable_manipulation.obstacles.mesh import MeshObstacle
from deformable_manipulation.obstacles.motions import (
    FrameMotion,
    Motion,
    PathMotion,
    PoseWaypoint,
    TopicMotion,
)
from deformable_manipulation.obstacles.polygon import PolygonObstacle
from deformable_manipulation.obstacles.primitives import (
    BoxObstacle,
    CapsuleObstacle,
    CylinderObstacle,
    HalfSpaceObstacle,
    SphereObstacle,
)
from deformable_manipulation.obstacles.spec import ObstacleSpec
from deformable_manipulation.obstacles.voxels import VoxelObstacle
from deformable_manipulation.reading.names import FRAME, ONE_LINE
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.pose import Pose
from deformable_manipulation.reading.readers import Custom
from deformable_manipulation.scenario.agents import ASSISTANT, LEADER, AgentSpec
from deformable_manipulation.scenario.barriers.collision import CollisionSpec
from deformable_manipulation.scenario.barriers.overstretch import OverstretchSpec
from deformable_manipulation.scenario.barriers.proximity import ProximitySpec
from deformable_manipulation.scenario.camera import CAMERA, CameraSpec
from deformable_manipulation.scenario.controller import (
    CENTRALISED,
    COORDINATED,
    DECENTRALISED,
    ControllerSpec,
)
from deformable_manipulation.scenario.correction import CORRECTION, CorrectionSpec
from deformable_manipulation.scenario.formulation import CONTROLLER
from deformable_manipulation.scenario.horizon import HorizonSpec
from deformable_manipulation.scenario.knowledge import KNOWLEDGE, KnowledgeSpec
from deformable_manipulation.scenario.simulation import SIMULATION, SimulationSpec
from deformable_manipulation.scenario.waypoints import (
    LEADER_PATH,
    LeaderSpec,
    Waypoint,
    WorkspaceSpec,
)

__all__ = [
    "ASSISTANT",
    "CENTRALISED",
    "COORDINATED",
    "DECENTRALISED",
    "LEADER",
    "AgentSpec",
    "BoxObstacle",
    "CameraSpec",
    "CapsuleObstacle",
    "CloudObstacle",
    "CollisionSpec",
    "ControllerSpec",
    "CorrectionSpec",
    "CylinderObstacle",
    "FabricSpec",
    "FieldObstacle",
    "HorizonSpec",
    "FrameMotion",
    "HalfSpaceObstacle",
    "KnowledgeSpec",
    "LeaderSpec",
    "LiveCloudObstacle",
    "LiveObstacle",
    "MeshObstacle",
    "Motion",
    "ObstacleSpec",
    "OverstretchSpec",
    "PathMotion",
    "PolygonObstacle",
    "Pose",
    "PoseWaypoint",
    "ProximitySpec",
    "Quaternion",
    "RodSpec",
    "Scenario",
    "SimulationSpec",
    "SphereObstacle",
    "TopicMotion",
    "Vector",
    "VoxelObstacle",
    "Waypoint",
    "WorkspaceSpec",
]


@dataclass(frozen=True)
class Scenario:
    """A whole run: object, agents, obstacles, leader, controller, simulation."""

    name: str = parameter(
        ONE_LINE,
        "Goes into the summary, the plots and the names of recordings. A copied file keeps it "
        "until you change it (`check_scenario` warns, `new_scenario --from` changes it).",
        default_text="the file's name without `.yaml`",
    )
    object: ObjectSpec = parameter(
        Custom(read_object, "a section with type and its keys"), "What is carried."
    )
    # The agents' starts follow from the object: their section is read when all others have been.
    agents: Tuple[AgentSpec, ...] = parameter(
        Custom(
            lambda node: node, "a section with one section per agent, by name", "sections by name"
        ),
        "Who carries it; exactly one leader.",
    )
    obstacles: Tuple[ObstacleSpec, ...] = parameter(
        Custom(read_obstacles, "a list of obstacles", "list"),
        "What it must not touch.",
        default_text="none",
    )
    leader: LeaderSpec = parameter(LEADER_PATH, "Where the leader goes.")
    controller: ControllerSpec = parameter(CONTROLLER, "How the assistants are controlled.")
    simulation: SimulationSpec = parameter(SIMULATION, "How the object is simulated.")
    correction: Optional[CorrectionSpec] = parameter(
        CORRECTION,
        "How measured points of the object correct its model "
        "([real_objects.md](real_objects.md#correction-while-it-runs)). Rods only.",
        default=None,
        default_text="none",
    )
    knowledge: KnowledgeSpec = parameter(
        KNOWLEDGE,
        "What the controllers do not know exactly, in runs without ROS.",
        default=KnowledgeSpec(),
        default_text="all defaults",
    )
    camera: Optional[CameraSpec] = parameter(
        CAMERA,
        "A simulated depth camera, whose points are the data of [live obstacles](#live-obstacles).",
        default=None,
        default_text="none",
    )
    frame: str = parameter(
        FRAME,
        "Fixed frame of all messages and of all positions here. Change it to fit your robot's tf "
        "tree.",
        default="map",
    )

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
