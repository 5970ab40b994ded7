"""The subject ``loop``: the nodes in real time, from a state to the commands that answer it."""

import tempfile
from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.scenario import load_scenario

SECONDS = {True: 5.0, False: 100.0}  # quick; full: until the ropes' barriers are active


@dataclass(frozen=True)
class Case:
    """A scenario, and when it is measured."""

    scenario: str
    warm_up: float = 3.0  # s, from the first command
    overrides: Tuple[Tuple[str, str], ...] = ()  # keys and values of the scenario


# The fabric comes to the cube only after 200 s. Here its leader is above it after 21 s, most of the
# way down when the measurement begins, and stays low above it until 151 s: without ROS the
# barriers of all assistants are active in each of these cycles.
_TO_THE_CUBE = tuple(
    (f"leader.waypoints.{index}.time", str(time))
    for index, time in enumerate((1, 21, 51, 101, 151, 201, 251), start=1)
)
CASES = (
    Case("rope_one_assistant"),
    Case("stiff_rod_one_assistant"),
    Case("rope_two_assistants"),
    Case("fabric_three_assistants", 40.0, _TO_THE_CUBE),
)

LATENCY_COLUMNS = (
    Column("scenario", "scenario"),
    Column("assistant", "assistant"),
    Column("rate", "commands [Hz]", ".1f"),
    Column("answered", "states answered [%]", ".2f"),
    Column("median_ms", "median [ms]", ".2f"),
    Column("p99_ms", "p99 [ms]", ".2f"),
    Column("maximum_ms", "maximum [ms]", ".1f"),
    Column("status", "status at the end"),
)
LOAD_COLUMNS = (
    Column("scenario", "scenario"),
    Column("node", "node"),
    Column("share", "of one core [%]", ".1f"),
    Column("memory", "memory, PSS [MB]", ".0f"),
    Column("overruns", "overruns", "d"),
    Column("skipped", "states skipped", "d"),
)
_SUMMED = ("share", "memory", "overruns", "skipped")
LATENCY_NOTES = (
    "from the stamp of a state, before it is published, to the receipt of the command that answers "
    "it by a recorder",
    "fabric_three_assistants: its leader gets to the cube in 51 s instead of 320 s; measured from "
    "40 s on, so that the barriers of the cube are active",
)
LOAD_NOTES = (
    "PSS counts memory that processes share in parts, so that the nodes' sum is what they take",
    "overruns: cycles of the whole run that took longer than a period or, of a node that answers "
    "states, were answered later than that",
)


def measure_tables(request: Request) -> List[Table]:
    """Run every scenario in real time, one after the other, on a master of its own."""
    # Loaded late: without ROS there is all the rest.
    from deformable_manipulation.ros.loop_trial import watch_loop
    from deformable_manipulation.ros.private_master import private_master

    latency = Table("latency", "State to command", LATENCY_COLUMNS, notes=list(LATENCY_NOTES))
    loads = Table("load", "Load of the nodes", LOAD_COLUMNS, notes=list(LOAD_NOTES))
    seconds = SECONDS[request.quick]
    for case in CASES[:1] if request.quick else CASES:
        request.say(f"{case.scenario}, {seconds:g} s after {case.warm_up:g} s")
        with tempfile.TemporaryDirectory() as directory, private_master(directory):
            scenario = load_scenario(case.scenario, case.overrides)
            measured = watch_loop(scenario, directory, seconds, case.warm_up)
        latency.rows += _latency_rows(scenario, measured)
        loads.rows += _load_rows(case.scenario, measured)
    return [latency, loads]


def _latency_rows(scenario, measured) -> List[dict]:
    rows = []
    for assistant, commands in measured.commands.items():
        median, p99, longest = 1e3 * np.percentile(commands.latencies, [50, 99, 100])
        rows.append(
            {
                "scenario": scenario.name,
                "assistant": assistant,
                "rate": commands.rate,
                "answered": 100.0 * commands.answered(scenario.controller.rate),
                "median_ms": median,
                "p99_ms": p99,
                "maximum_ms": longest,
                "status": commands.status.lower(),
            }
        )
    return rows


def _load_rows(scenario: str, measured) -> List[dict]:
    rows = [
        {
            "scenario": scenario,
            "node": node,
            "share": 100.0 * load.share,
            "memory": load.memory / 1e6,
            "overruns": load.overruns,
            "skipped": load.skipped,
        }
        for node, load in measured.nodes.items()
    ]
    sums = {key: sum(row[key] or 0 for row in rows) for key in _SUMMED}
    return [*rows, {"scenario": scenario, "node": "all", **sums}]
