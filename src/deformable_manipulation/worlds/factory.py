"""The world of a scenario."""

import dataclasses

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.scenario.knowledge import MUJOCO
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.simulation.factory import make_simulation


def true_scenario(scenario: Scenario) -> Scenario:
    """The scenario with the object as it is truly in place of the assumed one.

    That is its material, and a rod's finer pieces, of which an agent holds the one whose centre is
    that of its segment.
    """
    knowledge = scenario.knowledge
    finer = knowledge.refinement
    truth = scenario.object.with_factors(knowledge.stiffness_factor, knowledge.density_factor)
    if finer == 1 or not isinstance(truth, RodSpec):  # knowledge.for_object: fabrics have 1
        return dataclasses.replace(scenario, object=truth)
    agents = tuple(
        dataclasses.replace(agent, particle=finer * agent.particle + finer // 2)
        for agent in scenario.agents
    )
    return dataclasses.replace(scenario, object=truth.refined(finer), agents=agents)


def make_world(truth: Scenario, copies: bool = True):
    """The true object, settled between the agents at their starts.

    Args:
        truth: from :func:`true_scenario`.
        copies: with its perturbed copies, if it is this package's.

    Returns:
        ``_pbd.Simulation``, or what offers the same of an object without copies.

    Raises:
        WorldError: the engine is missing or has no such object.
        _pbd.ParameterError: a parameter is out of range.
    """
    if truth.knowledge.world == MUJOCO:
        # Imported late: most runs need none of it.
        from deformable_manipulation.worlds.engine_world import EngineWorld

        return EngineWorld(truth)
    return make_simulation(truth, copies)
