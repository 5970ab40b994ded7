"""Every material preset is simulated stably at a usual size."""

import numpy as np
import pytest

from deformable_manipulation.objects.kinds import KINDS
from deformable_manipulation.objects.materials import presets
from deformable_manipulation.scenario import scenario_from_mapping
from deformable_manipulation.simulation.factory import make_simulation

OBJECTS = {
    "rod": {"type": "rod", "length": 2.0, "segments": 28},
    "fabric": {"type": "fabric", "size": [1.0, 1.0], "resolution": 6},
}
STARTS = {  # particle -> position [m]
    "rod": {0: [0.0, 0.0, 0.0], 27: [1.6, 0.0, 0.0]},
    "fabric": {
        0: [0.04, 0.04, 0.0],
        6: [0.96, 0.04, 0.0],
        42: [0.04, 0.96, 0.0],
        48: [0.96, 0.96, 0.0],
    },
}
SPEED = 0.1  # m/s, of the assistants, upwards
CYCLE = 0.01  # s


def scenario_of(kind, name):
    agents = {
        f"agent_{particle}": {
            "particle": particle,
            "role": "assistant" if particle else "leader",
            "start": start,
        }
        for particle, start in STARTS[kind].items()
    }
    return scenario_from_mapping(
        {
            "object": {"material": name, **OBJECTS[kind]},
            "agents": agents,
            "leader": {"waypoints": [{"time": 0.0, "position": [0.0, 0.0, 0.0]}]},
            "controller": {"collision": {"offset": 0.05}},
            "simulation": {"duration": 1.0},
        },
        ".",
    )


def motions(simulation, cycles):
    """The greatest motion [m] of a point in each of so many cycles."""
    found = []
    before = simulation.points()[0].copy()
    for _ in range(cycles):
        simulation.advance()
        after = simulation.points()[0].copy()
        found.append(np.abs(after - before).max())
        before = after
    return np.array(found)


@pytest.mark.parametrize("kind, name", [(kind, name) for kind in KINDS for name in presets(kind)])
def test_it_rests_is_moved_without_jumps_and_comes_to_rest(kind, name):
    scenario = scenario_of(kind, name)
    simulation = make_simulation(scenario, copies=False)
    assert motions(simulation, 20).max() < 1e-5  # it starts settled
    for agent in scenario.assistants:
        simulation.set_command(agent, [0.0, 0.0, SPEED])
    # A limp sheet may fold over, no faster than a fold falls.
    assert motions(simulation, 100).max() < 10.0 * SPEED * CYCLE
    for agent in scenario.assistants:
        simulation.set_command(agent, [0.0, 0.0, 0.0])
    assert motions(simulation, 300)[-1] < 1e-6
    assert np.isfinite(simulation.points()).all()
    assert np.abs(simulation.points()).max() < 2.0
