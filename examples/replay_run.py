"""Record a run, read it back, and draw it."""

import numpy as np
from output_folder import output_folder

from deformable_manipulation.plots.overview_plot import plot_overview
from deformable_manipulation.plots.style import save_figure
from deformable_manipulation.recording import RunRecorder, read_run
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

folder = output_folder(__doc__)
scenario = load_scenario("rope_two_assistants", [("simulation.duration", "75")])
recorder = RunRecorder(scenario, folder / "run", overwrite=True)
try:
    ClosedLoop(scenario).run(recorder)
finally:
    recorder.finish(wall_time=0.0, completed=True)

# From here on it does not matter who made the run: read_run takes bags of the nodes, too.
run = read_run(folder / "run")
lowest = int(np.argmin(run.distance))
print(f"lowest distance {1e3 * run.distance[lowest]:.1f} mm at {run.time[lowest]:.1f} s")
for series in run.assistants:
    print(f"largest error of {series.agent}: {1e3 * np.nanmax(series.error_norm):.0f} mm")

frames = read_frames(run)
frame = frames.at(run.time[lowest])
print(f"height of the rope's lowest point then: {frames.points[frame, :, 2].min():.3f} m")
save_figure(plot_overview(run, frames), folder / "overview.png")
