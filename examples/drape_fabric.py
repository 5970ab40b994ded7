"""Let go of one corner of a held cloth and watch it fall into its new shape."""

from dataclasses import replace

from matplotlib.figure import Figure
from output_folder import output_folder

from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.simulation.factory import make_simulation

TIMES = (0.0, 0.3, 3.0)  # s after letting go

folder = output_folder(__doc__)
scenario = load_scenario("fabric_three_assistants")
softer = replace(scenario.object, bending_compliance=1e4)  # 1/(N m)
scenario = replace(scenario, object=softer)
simulation = make_simulation(scenario, copies=False)
simulation.release(scenario.assistants[2])

figure = Figure(figsize=(9, 3.5), layout="constrained")
for column, time in enumerate(TIMES):
    while simulation.time < time - 1e-9:
        simulation.advance()
    cloth = simulation.points()[0]  # (225, 3) m: the vertices
    lowest = cloth[:, 2].min()
    print(f"{simulation.time:.1f} s: the lowest point of the cloth is at z = {lowest:.2f} m")
    axes = figure.add_subplot(1, len(TIMES), column + 1, projection="3d", title=f"{time:g} s")
    axes.plot_trisurf(*cloth.T, triangles=scenario.object.triangles, cmap="viridis")
    axes.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2), zlim=(0.0, 2.2), xlabel="x [m]", ylabel="y [m]")
    axes.set_box_aspect((1.0, 1.0, 0.9))

figure.savefig(folder / "cloth.png", dpi=150)
