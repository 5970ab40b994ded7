"""A run made up of smooth curves, as the recorder gets it from a closed loop."""

import dataclasses

import numpy as np

from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.status import Status
from deformable_manipulation.motion.obstacle_motion import moving_obstacles
from deformable_manipulation.recording import CycleRecord, CycleTimings
from deformable_manipulation.scenario import scenario_from_mapping

RATE = 100.0
OFFSET = 0.05
POINTS = 6


def make_scenario(directory, assistants=1, duration=2.0, record_rate=10.0):
    agents = {"leader": {"particle": 0, "role": "leader"}}
    for number in range(1, assistants + 1):
        particle = number * (POINTS - 2) // assistants
        agents[f"assistant_{number}"] = {
            "particle": particle,
            "role": "assistant",
            "start": [0.1 + 0.3 * number, 0.0, 0.0],
        }
    mapping = {
        "name": "synthetic",
        "object": {
            "type": "rod",
            "length": 1.0,
            "radius": 0.005,
            "density": 1000.0,
            "segments": POINTS - 1,
            "young_modulus": 1e6,
            "torsion_modulus": 1e6,
        },
        "agents": agents,
        "leader": {"waypoints": [{"time": 0.0, "position": [0.0, 0.0, 0.0]}]},
        "controller": {"rate": RATE, "collision": {"offset": OFFSET}},
        "simulation": {"duration": duration, "record_rate": record_rate},
    }
    return scenario_from_mapping(mapping, directory)


def make_decision(cycle, phase=0.0, status=None):
    """A decision whose every number differs from the others and from cycle to cycle."""
    time = cycle / RATE + phase
    wave = np.sin(time + np.arange(24.0))
    distance = 0.06 + 0.02 * np.sin(cycle / RATE)
    return Decision(
        status=Status.CONSTRAINED if status is None else status,
        text="",
        enabled=True,
        command=wave[0:3],
        nominal=wave[3:6],
        position=wave[6:9],
        target=wave[6:9] + wave[9:12],
        error=wave[9:12],
        distance=distance,
        h={"collision": distance - OFFSET, "overstretch": wave[12], "proximity": wave[13]},
        jacobian=wave[14:17],
        leader_drift=wave[17],
        rows=3 + cycle % 2,
        slack={"collision": wave[18], "overstretch": wave[19], "proximity": wave[20]},
        solve_time=1e-5 * (1 + cycle % 3),
    )


def make_record(scenario, cycle, **changes):
    agents = len(scenario.agents)
    names = [scenario.agents[index].name for index in scenario.assistants]
    decisions = {name: make_decision(cycle, phase) for phase, name in enumerate(names)}
    record = CycleRecord(
        cycle=cycle,
        time=cycle / RATE,
        distance=decisions[names[0]].distance,
        stretch=1e-6 * (cycle % 7),
        positions=np.arange(3.0 * agents).reshape(agents, 3) + cycle,
        velocities=-np.arange(3.0 * agents).reshape(agents, 3) - cycle,
        points=np.arange(3.0 * POINTS).reshape(POINTS, 3) + 0.1 * cycle,
        obstacles=np.zeros((len(moving_obstacles(scenario)), 7)) + cycle,
        decisions=decisions,
        timings=CycleTimings(1e-3 * (cycle + 1), 2e-3, 3e-3),
    )
    return dataclasses.replace(record, **changes)
