"""Recording of a run, and reading it back from its folder or from a bag."""

from deformable_manipulation.recording.run_data import AssistantSeries, RunData, RunDataError
from deformable_manipulation.recording.run_files import RecordingError
from deformable_manipulation.recording.run_reader import read_run
from deformable_manipulation.recording.run_recorder import RunRecorder
from deformable_manipulation.recording.timeseries import CycleRecord, CycleTimings

__all__ = [
    "AssistantSeries",
    "CycleRecord",
    "CycleTimings",
    "RecordingError",
    "RunData",
    "RunDataError",
    "RunRecorder",
    "read_run",
]
