"""Reads the folder that ``run_scenario`` wrote."""

import csv
import json
from pathlib import Path
from typing import Dict, List, Tuple

import numpy as np
import yaml

from deformable_manipulation.objects.common import LARGEST_VALID_STRETCH
from deformable_manipulation.recording import run_files
from deformable_manipulation.recording.run_data import (
    H_PREFIX,
    SERIES_COLUMNS,
    TURNING_SERIES_COLUMNS,
    RunData,
    RunDataError,
    make_assistant_series,
    offset_of,
)
from deformable_manipulation.simulation.stretch import largest_stretch
from deformable_manipulation.system.text_files import TextFileError, read_text

STATUS_SUFFIX = ".status"  # only assistants have a status


def read_folder(folder: Path) -> RunData:
    """Read ``timeseries.csv`` of a run folder.

    Raises:
        RunDataError: it cannot be read, is cut off, or lacks columns or rows.
    """
    path = folder / run_files.TIMESERIES
    header, rows = _read_rows(path)
    agents = [name[: -len(STATUS_SUFFIX)] for name in header if name.endswith(STATUS_SUFFIX)]
    wanted = ["time", "distance"]
    series = {agent: _series_columns(agent, header) for agent in agents}
    wanted += [f"{agent}.{column}" for agent in agents for column in series[agent]]
    # Folders of earlier versions have no stretch.
    recorded_stretch = [name for name in ("stretch",) if name in header]
    columns = _select_columns(path, header, rows, wanted + recorded_stretch)
    summary = _read_summary(folder / run_files.SUMMARY)
    assistants = tuple(
        make_assistant_series(
            agent,
            columns["time"],
            columns["distance"],
            {name: columns[f"{agent}.{name}"] for name in series[agent]},
        )
        for agent in agents
    )
    return RunData(
        name=folder.resolve().name,
        path=folder,
        time=columns["time"],
        distance=columns["distance"],
        offset=offset_of(assistants),
        assistants=assistants,
        max_stretch=largest_stretch(columns.get("stretch", np.empty(0))),
        valid_stretch=_valid_stretch(summary),
        scenario=_scenario_name(summary, folder / run_files.SCENARIO),
    )


def _series_columns(agent: str, header: List[str]) -> List[str]:
    """Columns of an assistant that its series is made of: fixed ones, and those of its barriers."""
    start = f"{agent}.{H_PREFIX}"
    barriers = [name[len(agent) + 1 :] for name in header if name.startswith(start)]
    turning = [name for name in TURNING_SERIES_COLUMNS if f"{agent}.{name}" in header]
    return [*SERIES_COLUMNS, *turning, *barriers]


def _read_summary(path: Path) -> dict:
    """The summary; empty if there is none, as of a run that was killed."""
    try:
        summary = json.loads(read_text(path))
    except ValueError:  # also a TextFileError
        return {}
    return summary if isinstance(summary, dict) else {}


def _valid_stretch(summary: dict) -> float:
    """The value for rods if it is missing, as from earlier versions."""
    try:
        return float(summary["valid_stretch"])
    except (KeyError, ValueError, TypeError):
        return LARGEST_VALID_STRETCH


def _scenario_name(summary: dict, path: Path) -> str:
    """From the summary, or else the scenario's file; empty if neither has it."""
    try:
        return str(summary.get("scenario") or yaml.safe_load(read_text(path))["name"])
    except (TextFileError, yaml.YAMLError, KeyError, TypeError):
        return ""


def _read_rows(path: Path) -> Tuple[List[str], List[List[str]]]:
    try:
        with open(str(path), newline="", encoding="utf-8") as file:
            reader = csv.reader(file)
            header = next(reader, [])
            rows = list(reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RunDataError(f"{path} cannot be read: {error}") from error
    if not rows:
        raise RunDataError(f"{path} contains no cycle: the run stopped before its first")
    for line, row in enumerate(rows, start=2):
        if len(row) != len(header):
            raise RunDataError(
                f"{path} line {line}: {len(row)} values for {len(header)} columns; the file is cut "
                "off or was edited"
            )
    return header, rows


def _select_columns(
    path: Path, header: List[str], rows: List[List[str]], wanted: List[str]
) -> Dict[str, np.ndarray]:
    missing = [name for name in wanted if name not in header]
    if missing:
        raise RunDataError(
            "{} lacks the columns {}; it is not the time series of a run".format(
                path, ", ".join(missing)
            )
        )
    columns = {}
    for name in wanted:
        index = header.index(name)
        try:
            columns[name] = np.array([float(row[index]) for row in rows])
        except ValueError as error:
            raise RunDataError(f"{path} column {name}: {error}") from error
    return columns
