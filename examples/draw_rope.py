"""Carry a rope with two hands and draw its shape, once per second."""

from matplotlib.figure import Figure
from output_folder import output_folder

from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.simulation.factory import make_simulation

SECONDS = 6
VELOCITY = [0.0, -0.1, 0.1]  # m/s, of the assistant's hand: back and up

folder = output_folder(__doc__)
scenario = load_scenario("rope_one_assistant")
simulation = make_simulation(scenario, copies=False)  # the rope hangs at rest between its holders
assistant = scenario.assistants[0]

figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.add_subplot(xlabel="y [m]", ylabel="z [m]", aspect="equal")
simulation.set_command(assistant, VELOCITY)
for _ in range(SECONDS + 1):
    rope = simulation.points()[0]  # (29, 3) m: the ends of the 28 segments
    force, _ = simulation.wrench(assistant)
    print(
        f"{simulation.time:4.1f} s: lowest point {rope[:, 2].min():.3f} m, "
        f"force on the assistant's hand ({force[1]:5.2f}, {force[2]:5.2f}) N"
    )
    axes.plot(rope[:, 1], rope[:, 2], label=f"{simulation.time:.0f} s")
    for _ in range(round(1.0 / scenario.cycle_time)):
        simulation.advance()

axes.legend(ncols=2)
figure.savefig(folder / "rope.png", dpi=150)
