"""Compare the full controller with the paper's equations, and with no safety filter at all."""

from matplotlib.figure import Figure
from output_folder import output_folder

from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

DURATION = 110.0  # s


def distances(formulation: str, safety: bool):
    """Times [s] and distances [m] from the ground of a run."""
    overrides = [
        ("simulation.duration", str(DURATION)),
        ("controller.formulation", formulation),
    ]
    scenario = load_scenario("rope_one_assistant", overrides)
    loop = ClosedLoop(scenario, safety)
    records = [loop.step() for _ in range(scenario.cycles)]
    return [record.time for record in records], [record.distance for record in records]


folder = output_folder(__doc__)
figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.add_subplot(xlabel="time [s]", ylabel="distance from the ground [m]")
for label, formulation, safety in (
    ("full", "full", True),
    ("paper", "paper", True),
    ("no safety filter", "full", False),
):
    time, distance = distances(formulation, safety)
    print(f"{label:>16}: lowest distance {1e3 * min(distance):7.1f} mm")
    axes.plot(time, distance, label=label)

offset = load_scenario("rope_one_assistant").controller.collision.offset
axes.axhline(offset, color="black", linestyle="--", label="distance to keep")
axes.set_ylim(-0.1, 0.2)
axes.legend()
figure.savefig(folder / "formulations.png", dpi=150)
