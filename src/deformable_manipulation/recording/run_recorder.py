"""Records a run and writes its files, also those of a run that was interrupted."""

from pathlib import Path

import numpy as np

from deformable_manipulation.motion.obstacle_motion import moving_obstacles
from deformable_manipulation.recording import run_files
from deformable_manipulation.recording.summary import summarise, write_summary
from deformable_manipulation.recording.timeseries import CycleRecord, TimeSeries
from deformable_manipulation.recording.waits import Wait
from deformable_manipulation.scenario import scenario_to_yaml
from deformable_manipulation.scenario.spec import Scenario

# Keeps a frame that is due at a whole cycle from slipping to the next one by rounding.
FRAME_TOLERANCE = 1e-9


class RunRecorder:
    """Keeps every cycle of a run in memory and writes the files of the run at the end.

    Usage: ``record`` once per cycle, and ``finish`` in a ``finally`` block, so that a run that
    stops early leaves what it had. See docs/interfaces.md, "Files of a run".
    """

    def __init__(
        self,
        scenario: Scenario,
        directory,
        safety: bool = True,
        overwrite: bool = False,
        start: str = "stable",
    ):
        """Prepare the folder and write the scenario into it.

        ``safety`` says whether the safety filter is on; ``overwrite`` allows a folder that
        already contains a run; ``start`` says how the object rests at the start, see
        ``_pbd.Simulation.rest``.

        Raises:
            RecordingError: the folder holds a run already or cannot be written.
        """
        self.directory = Path(directory)
        self._scenario = scenario
        self._safety = safety
        self._start = start
        self._series = TimeSeries.of(scenario)
        self._waits = {name: Wait() for name in self._series.assistants}
        # (time, points, agents, obstacles, model); one append each, never half a frame
        self._frames = []
        self._last_frame = -1
        self._frames_per_cycle = scenario.simulation.record_rate, scenario.controller.rate
        run_files.prepare_folder(self.directory, overwrite)
        self._write(run_files.SCENARIO, self._write_scenario)

    def record(self, record: CycleRecord) -> None:
        """Keep one cycle (copies all arrays)."""
        self._series.append(record)
        for name, wait in self._waits.items():
            decision = record.decisions[name]
            wait.add(decision.status, decision.reason)
        record_rate, rate = self._frames_per_cycle
        frame = int(record.cycle * record_rate / rate + FRAME_TOLERANCE)
        if frame != self._last_frame:
            self._last_frame = frame
            self._frames.append(
                (
                    record.time,
                    np.array(record.points, dtype=np.float32),
                    np.array(record.positions, dtype=np.float32),
                    np.array(record.obstacles, dtype=np.float32),
                    record.model and record.model.points.astype(np.float32),
                )
            )

    def finish(self, wall_time: float, completed: bool) -> dict:
        """Write everything recorded so far; returns the content of ``summary.json``.

        ``wall_time`` [s] of the run; ``completed``: false when it stopped before its end.

        Raises:
            RecordingError: a file cannot be written. The other files are written all the same.
        """
        summary = summarise(
            self._scenario,
            self._series,
            wall_time,
            completed,
            self._safety,
            self._start,
            self._waits,
        )
        failures = []
        for name, write, binary in (
            (run_files.TIMESERIES, self._series.write_csv, False),
            (run_files.STATES, self._write_states, True),
            (run_files.SUMMARY, lambda file: write_summary(summary, file), False),
        ):
            try:
                self._write(name, write, binary)
            except run_files.RecordingError as error:
                failures.append(str(error))
        if failures:
            raise run_files.RecordingError("\n".join(failures))
        return summary

    def _write(self, name: str, write, binary: bool = False) -> None:
        path = self.directory / name
        try:
            with run_files.atomic_file(path, binary) as file:
                write(file)
        except OSError as error:
            raise run_files.RecordingError(
                f"cannot write {path}: {error.strerror or error}"
            ) from error

    def _write_scenario(self, file) -> None:
        file.write(scenario_to_yaml(self._scenario))

    def _write_states(self, file) -> None:
        times, points, agents, obstacles, model = zip(*self._frames) if self._frames else ((),) * 5
        agent_names = [agent.name for agent in self._scenario.agents]
        arrays = {
            "times": np.array(times, dtype=np.float32),
            "points": np.stack(points) if points else np.zeros((0, 0, 3), np.float32),
            "agents": np.array(agents, np.float32).reshape(len(times), len(agent_names), 3),
            "agent_names": np.array(agent_names),
        }
        moving = [self._scenario.obstacles[i].name for i in moving_obstacles(self._scenario)]
        if moving:
            arrays["obstacles"] = np.array(obstacles, np.float32).reshape(len(times), -1, 7)
            arrays["obstacle_names"] = np.array(moving)
        if model and model[0] is not None:
            arrays["model_points"] = np.stack(model)
        faces = self._scenario.object.faces()
        if faces is not None:
            arrays["faces"] = faces.astype(np.int32)
        np.savez_compressed(file, **arrays)
