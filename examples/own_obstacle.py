"""Carry the rope over an obstacle of your own."""

from dataclasses import replace

from matplotlib.figure import Figure
from output_folder import output_folder

from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.spec import PolygonObstacle

STAIRS = ((-1.0, 0.0), (0.9, 0.0), (0.9, 0.2), (1.5, 0.2), (1.5, 0.4), (2.1, 0.4), (2.1, 0.6))
STAIRS += ((4.0, 0.6), (4.0, -1.0), (-1.0, -1.0))  # m, the corners of a closed ring, y and z
DURATION = 80.0  # s

folder = output_folder(__doc__)
scenario = load_scenario("rope_one_assistant", [("simulation.duration", str(DURATION))])
scenario = replace(scenario, obstacles=(PolygonObstacle("stairs", STAIRS, plane="yz"),))

loop = ClosedLoop(scenario)
records = [loop.step() for _ in range(scenario.cycles)]
lowest = min(records, key=lambda record: record.distance)
print(f"lowest distance from the stairs: {1e3 * lowest.distance:.1f} mm at {lowest.time:.1f} s")

figure = Figure(figsize=(6, 3.5), layout="constrained")
axes = figure.add_subplot(xlabel="y [m]", ylabel="z [m]", aspect="equal")
axes.fill(*zip(*STAIRS), color="#c8c8c8")
for record in sorted([*records[::1600], lowest], key=lambda record: record.time):
    label = f"{record.time:.0f} s: {1e3 * record.distance:.0f} mm"
    axes.plot(record.points[:, 1], record.points[:, 2], label=label)
axes.set(xlim=(-0.3, 4.0), ylim=(-0.2, 2.0))
limit = scenario.controller.collision.offset
axes.set_title(f"distance to the stairs (limit {1e3 * limit:.0f} mm)")
axes.legend(loc="upper right")
figure.savefig(folder / "stairs.png", dpi=150)
