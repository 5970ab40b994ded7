"""The subject ``cycle``: what the parts of a controller cycle take, in one process without ROS."""

import time
from typing import Dict, List

import numpy as np

from deformable_manipulation.benchmarks.harness import Timing, no_garbage_collection
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.control.status import Status
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

SCENARIOS = ("rope_one_assistant", "stiff_rod_one_assistant")
FORMULATIONS = ("full", "paper")
CYCLES = {True: 500, False: None}  # quick, full: the whole run
WHOLE = "whole cycle"

COLUMNS = (
    Column("scenario", "scenario"),
    Column("formulation", "formulation"),
    Column("part", "part"),
    Column("median_us", "median [µs]", ".1f"),
    Column("p99_us", "p99 [µs]", ".1f"),
    Column("minimum_us", "minimum [µs]", ".1f"),
)
NOTES = (
    "simulation: the object with all copies, one thread; distances: with reading the state and, in "
    "full, the object's exact response; controller: of one assistant, from the observation to its "
    "decision; solver: of that, rows and bounds to a checked velocity, in cycles where the nominal "
    "velocity is none",
    f"{WHOLE}: all of them, the leader and the record",
)


def measure_tables(request: Request) -> List[Table]:
    """Run the scenarios and time every cycle."""
    table = Table("parts", "One cycle, one assistant", COLUMNS, notes=list(NOTES))
    for name in SCENARIOS[:1] if request.quick else SCENARIOS:
        for formulation in FORMULATIONS:
            request.say(f"{name}, {formulation}")
            scenario = load_scenario(name, [("controller.formulation", formulation)])
            count = CYCLES[request.quick] or scenario.cycles
            for part, seconds in _run(ClosedLoop(scenario), count).items():
                table.rows.append(_row(name, formulation, part, seconds))
    return [table]


def _run(loop: ClosedLoop, cycles: int) -> Dict[str, List[float]]:
    """Seconds of each part in every cycle."""
    parts: Dict[str, List[float]] = {
        "simulation": [],
        "distances": [],
        "controller": [],
        "solver": [],
        WHOLE: [],
    }
    with no_garbage_collection():
        for _ in range(cycles):
            started = time.perf_counter()
            record = loop.step()
            parts[WHOLE].append(time.perf_counter() - started)
            parts["simulation"].append(record.timings.simulation)
            parts["distances"].append(record.timings.distance)
            for decision in record.decisions.values():
                parts["controller"].append(decision.computation_time)
                if decision.status not in (Status.NOMINAL, Status.WAITING):
                    parts["solver"].append(decision.solve_time)
    return parts


def _row(name: str, formulation: str, part: str, seconds: List[float]) -> dict:
    timing = Timing(seconds or [np.nan])
    return {
        "scenario": name,
        "formulation": formulation,
        "part": part,
        "median_us": 1e6 * timing.median,
        "p99_us": 1e6 * timing.quantile(0.99),
        "minimum_us": 1e6 * timing.minimum,
        "cycles": len(seconds),
    }
