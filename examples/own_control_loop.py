"""Use the safe controller in a loop of your own, with a leader of your own."""

import math

import numpy as np
from matplotlib.figure import Figure
from output_folder import output_folder

from deformable_manipulation.control.team import TeamController
from deformable_manipulation.running.closed_loop import make_minimum_distance
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.simulation.factory import make_simulation
from deformable_manipulation.simulation.observer import Observer

DURATION = 40.0  # s
PERIOD = 40.0  # s, of the leader's way down to the ground and up again
DEPTH = 1.2  # m


def leader_velocity(time: float) -> np.ndarray:
    """Down and up along a cosine [m/s]."""
    rate = 2.0 * math.pi / PERIOD
    return np.array([0.0, 0.0, -0.5 * DEPTH * rate * math.sin(rate * time)])


folder = output_folder(__doc__)
scenario = load_scenario("rope_one_assistant")
simulation = make_simulation(scenario)  # with the displaced copies that the controller needs
observer = Observer(scenario, simulation, make_minimum_distance(scenario))
controller = TeamController(scenario, ["assistant_1"])

times, distances, errors = [], [], []
while simulation.time < DURATION:
    observation = observer.observe()
    decision = controller.update(observation)["assistant_1"]
    simulation.advance()
    simulation.set_command(scenario.leader_index, leader_velocity(observation.time))
    simulation.set_command(scenario.assistants[0], decision.command)
    times.append(observation.time)
    distances.append(decision.distance)
    errors.append(np.linalg.norm(decision.error))

offset = scenario.controller.collision.offset
print(
    f"lowest distance from the ground: {1e3 * min(distances):.1f} mm, to keep: {1e3 * offset:g} mm"
)
print(f"farthest from its place beside the leader: {1e3 * max(errors):.0f} mm")
figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.add_subplot(xlabel="time [s]", ylabel="[m]")
axes.plot(times, distances, label="distance of the rope from the ground")
axes.plot(times, errors, label="distance of the assistant from its place")
axes.axhline(offset, color="black", linestyle="--", label="distance to keep")
axes.legend()
figure.savefig(folder / "own_control_loop.png", dpi=150)
