"""What the assistants' grips do about their orientations, and who can do that."""

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Report
from deformable_manipulation.scenario.agents import PINNED

FIXED, FOLLOW, FREE = "fixed", "follow", "free"


def check_orientation(report: Report, spec, agents, controller, knowledge) -> None:
    """Grips that are to turn can."""
    path = ("controller", "orientation")
    if not controller.turns:
        return
    if not knowledge.sees_object:
        report.add(
            path,
            f"must be {FIXED} with imperfect knowledge, whose model does not follow turned grips",
            controller.orientation,
        )
    turning = [
        each for each in agents if each.role == "assistant" or controller.orientation == FOLLOW
    ]
    if spec.is_surface:
        _check_turning_fabric(report, path, spec, turning, controller)
    pinned = [agent.name for agent in turning if agent.hold == PINNED and not spec.is_surface]
    if pinned:
        report.add(
            path,
            f"must be {FIXED}, as a pinned grip turns nothing: {', '.join(pinned)}. Use hold: "
            "clamped to turn the object",
            controller.orientation,
        )
    if controller.jacobian != "equilibrium":
        report.add(
            path,
            f"must be {FIXED} with jacobian: {controller.jacobian}: copies do not tell how the "
            "object follows a turn. Use jacobian: equilibrium",
            controller.orientation,
        )


def check_turning_leader(report: Report, leader, controller, knowledge) -> None:
    """A leader's path turns it only where the controllers know what that does."""
    turned = [index for index, each in enumerate(leader.waypoints) if each.is_turned]
    if not turned:
        return
    path = ("leader", "waypoints", str(turned[0]), "orientation")
    if not controller.turns:
        report.add(
            path,
            f"must be [0, 0, 0, 1] with controller.orientation: {FIXED}, whose assistants do not "
            f"know what the leader's turns do. Use {FOLLOW} or {FREE}",
            show(list(leader.waypoints[turned[0]].orientation)),
        )
    elif not knowledge.sees_object:
        report.add(
            path,
            "must be [0, 0, 0, 1] with imperfect knowledge, whose model does not turn with its "
            "leader",
            show(list(leader.waypoints[turned[0]].orientation)),
        )


def _check_turning_fabric(report: Report, path, spec, turning, controller) -> None:
    """Grips of a fabric turn it if they hold several vertices."""
    single = [agent.name for agent in turning if not agent.further_particles]
    if single:
        report.add(
            path,
            f"must be {FIXED}: a grip that holds one vertex of a {spec.type} cannot turn it: "
            f"{', '.join(single)}. Give it further_particles",
            controller.orientation,
        )
