"""Times of waypoints."""

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Node, Number

TIME = Number("s", at_least=0.0, at_most=1e6)
SHORTEST_PIECE = 1e-3  # s; what is shorter is a leap, and its velocity no number in the end


def check_times(node: Node, waypoints) -> None:
    """Each waypoint comes after the one before."""
    for index, (before, waypoint) in enumerate(zip(waypoints, waypoints[1:]), start=1):
        if waypoint.time - before.time < SHORTEST_PIECE:
            node.report.add(
                node.path + (str(index), "time"),
                "must be at least {:g} s later than the waypoint before ({:g} s)".format(
                    SHORTEST_PIECE, before.time
                ),
                show(waypoint.time),
            )
