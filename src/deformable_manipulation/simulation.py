"""The simulation core for a scenario."""

from functools import singledispatch

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.scenario.spec import FabricSpec, RodSpec, Scenario, SimulationSpec


@singledispatch
def make_body(spec, simulation: SimulationSpec) -> _pbd.Body:
    """The scenario's object, undeformed and held nowhere.

    Raises:
        _pbd.ParameterError: a parameter is out of range.
    """
    raise TypeError("no simulation of objects of {}".format(type(spec).__name__))


@make_body.register(RodSpec)
def _make_rod(spec: RodSpec, simulation: SimulationSpec) -> _pbd.Rod:
    return _pbd.Rod(
        length=spec.length,
        radius=spec.radius,
        density=spec.density,
        segments=spec.segments,
        young_modulus=spec.young_modulus,
        torsion_modulus=spec.torsion_modulus,
        stretch=spec.stretch,
        damping=spec.damping,
        solver=simulation.solver,
        gravity=simulation.gravity,
        position=spec.pose.position,
        orientation=spec.pose.orientation,
    )


@make_body.register(FabricSpec)
def _make_fabric(spec: FabricSpec, simulation: SimulationSpec) -> _pbd.Body:
    return _pbd.Fabric(
        vertices=np.array(spec.vertices),
        triangles=np.array(spec.triangles),
        density=spec.density,
        thickness=spec.thickness,
        stretching_compliance=spec.stretching_compliance,
        bending_compliance=spec.bending_compliance,
        damping=spec.damping,
        gravity=simulation.gravity,
        position=spec.pose.position,
        orientation=spec.pose.orientation,
    )


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
        (agent.name, agent.particle, agent.hold, agent.start, agent.orientation)
        for agent in scenario.agents
    ]
    return _pbd.Simulation(
        make_body(scenario.object, scenario.simulation),
        agents,
        perturbations(scenario) if copies else [],
        time_step=scenario.simulation.time_step,
        substeps=scenario.simulation.substeps,
        steps_per_cycle=scenario.steps_per_cycle,
    )
