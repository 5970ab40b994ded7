"""Lower a rope towards a mesh and see how far it is from it, and where it is nearest."""

import numpy as np

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.scenario import load_scenario, package_share_directory
from deformable_manipulation.scenario.spec import MeshObstacle
from deformable_manipulation.simulation.factory import make_simulation

DOWN = [0.0, 0.0, -0.1]  # m/s

cube = MeshObstacle(
    name="cube",
    mesh=str(package_share_directory() / "config" / "obstacles" / "cube.obj"),
    translation=(0.0, 1.1, 0.0),
    scale=(1.0, 0.2, 0.4),
)
scenario = load_scenario("rope_one_assistant")
simulation = make_simulation(scenario, copies=False)
for agent in range(len(scenario.agents)):
    simulation.set_command(agent, DOWN)

# Rows for all segments that are nearly as near as the nearest one; here only that one is of use.
distance = MinimumDistance([cube], margin=scenario.object.radius, band=0.01)
for _ in range(9):
    distances = distance.compute(simulation.points())
    nearest = distances.of_copy(0).start  # the features of a copy begin with its nearest one
    segment = distances.vertices[nearest][0]
    normal = np.round(distances.normal[nearest], 2) + 0.0  # no negative zeros
    print(
        f"{simulation.time:3.0f} s: {distances.minimum[0]:6.3f} m from the {distances.names[0]}, "
        f"at segment {segment}; the normal is {normal.tolist()}"
    )
    for _ in range(100):
        simulation.advance()
