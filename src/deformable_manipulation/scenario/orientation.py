"""What the assistants' grips do about their orientations, and who can do that."""

from deformable_manipulation.reading.readers import Report

FIXED, FOLLOW, FREE = "fixed", "follow", "free"


def check_orientation(report: Report, spec, agents, controller, knowledge) -> None:
    """Grips that are to turn can."""
    path = ("controller", "orientation")
    if not controller.turns:
        return
    if not spec.has_joints:
        report.add(
            path,
            f"must be {FIXED}: a grip holds one vertex of a {spec.type} and cannot turn it",
            controller.orientation,
        )
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
    pinned = [agent.name for agent in turning if agent.hold == "pinned"]
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
