"""The subject ``loop``: the nodes in real time, from a state to the commands that answer it."""

import tempfile
from typing import List

import numpy as np

from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.scenario import load_scenario

SCENARIOS = (
    "rope_one_assistant",
    "stiff_rod_one_assistant",
    "rope_two_assistants",
    "fabric_three_assistants",
)
SECONDS = {True: 5.0, False: 100.0}  # quick; full: until the ropes' barriers are active

LATENCY_COLUMNS = (
    Column("scenario", "scenario"),
    Column("assistant", "assistant"),
    Column("rate", "commands [Hz]", ".1f"),
    Column("answered", "states answered [%]", ".2f"),
    Column("median_ms", "median [ms]", ".2f"),
    Column("p99_ms", "p99 [ms]", ".2f"),
    Column("maximum_ms", "maximum [ms]", ".1f"),
)
LOAD_COLUMNS = (
    Column("scenario", "scenario"),
    Column("node", "node"),
    Column("share", "of one core [%]", ".1f"),
    Column("memory", "memory, PSS [MB]", ".0f"),
)
LATENCY_NOTES = (
    "from the stamp of a state, before it is published, to the receipt of the command that answers "
    "it by a recorder",
)
LOAD_NOTES = (
    "PSS counts memory that processes share in parts, so that the nodes' sum is what they take",
)


def measure_tables(request: Request) -> List[Table]:
    """Run every scenario in real time, one after the other, on a master of its own."""
    # Loaded late: without ROS there is all the rest.
    from deformable_manipulation.ros.loop_trial import watch_loop
    from deformable_manipulation.ros.private_master import private_master

    latency = Table("latency", "State to command", LATENCY_COLUMNS, notes=list(LATENCY_NOTES))
    loads = Table("load", "Load of the nodes", LOAD_COLUMNS, notes=list(LOAD_NOTES))
    seconds = SECONDS[request.quick]
    for name in SCENARIOS[:1] if request.quick else SCENARIOS:
        request.say(f"{name}, {seconds:g} s")
        with tempfile.TemporaryDirectory() as directory, private_master(directory):
            scenario = load_scenario(name)
            measured = watch_loop(scenario, directory, seconds)
        latency.rows += _latency_rows(scenario, measured)
        loads.rows += _load_rows(name, measured)
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
            }
        )
    return rows


def _load_rows(scenario: str, measured) -> List[dict]:
    def row(node, share, memory):
        return {"scenario": scenario, "node": node, "share": 100.0 * share, "memory": memory / 1e6}

    nodes = measured.nodes
    rows = [row(node, load.share, load.memory) for node, load in nodes.items()]
    total = [sum(getattr(load, key) for load in nodes.values()) for key in ("share", "memory")]
    return [*rows, row("all", *total)]
