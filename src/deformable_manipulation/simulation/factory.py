"""The simulation core for a scenario."""

from deformable_manipulation import _pbd
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario.spec import Scenario


def perturbations(scenario: Scenario):
    """Displacements (agent index, (3,) [m]) of the copies (paper, section VI).

    Per assistant and axis one for forward differences, two for central ones.
    """
    sides = (1.0, -1.0) if scenario.controller.differences == "central" else (1.0,)
    displaced = []
    for agent in scenario.assistants:
        for axis, distance in enumerate(scenario.controller.perturbation):
            for side in sides:
                displacement = [0.0, 0.0, 0.0]
                displacement[axis] = side * distance
                displaced.append((agent, displacement))
    return displaced


def make_simulation(scenario: Scenario, copies: bool = True) -> _pbd.Simulation:
    """The object, settled between the agents at their starts.

    Args:
        copies: with its perturbed copies, or without.

    Raises:
        _pbd.ParameterError: a parameter is out of range.
    """
    agents = [
        (
            agent.name,
            agent.particle,
            agent.hold,
            agent.start,
            agent.orientation,
            agent.further_particles,
        )
        for agent in scenario.agents
    ]
    return _pbd.Simulation(
        make_body(scenario.object, scenario.simulation.gravity, scenario.simulation.solver),
        agents,
        perturbations(scenario) if copies else [],
        time_step=scenario.simulation.time_step,
        substeps=scenario.simulation.substeps,
        steps_per_cycle=scenario.steps_per_cycle,
    )
