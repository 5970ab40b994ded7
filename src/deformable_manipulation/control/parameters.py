"""The native controller's parameters from a scenario."""

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.scenario import pair_limits


def native_parameters(scenario, agent, safety):
    """What ``_control.AssistantController`` is made of.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        agent: name of the assistant.
        safety: False leaves the barriers out.

    Raises:
        ValueError: the scenario has no assistant of that name, or the solver is not installed.
    """
    settings = scenario.controller
    index, leader = _index_of(scenario, agent), scenario.leader_index
    starts = np.array([each.start for each in scenario.agents], dtype=float)
    limits = [
        pair_limits(scenario, index, other) if other != index else None
        for other in range(len(starts))
    ]
    return {
        "agent": index,
        "leader": leader,
        "assistants": list(scenario.assistants),
        "reference": starts[index] - starts[leader],
        "cycle_time": scenario.cycle_time,
        "gain": settings.gain,
        "weights": settings.weights,
        "max_velocity": settings.max_velocity,
        "max_acceleration": settings.max_acceleration,
        "timeout": settings.timeout,
        "exact_gradients": settings.jacobian == "equilibrium",
        "safety": safety,
        "formulation": _formulation(settings),
        "priority": list(settings.priority),
        "solver": find_solver(settings.solver),
        "collision": {
            "offset": settings.collision.offset,
            "margin": settings.collision.margin,
            "speed_margin": settings.collision.speed_margin,
            "band": settings.collision.band,
            "alpha": settings.collision.alpha,
            "anticipation": settings.collision.anticipation,
        },
        "overstretch": _pair(settings.overstretch, limits, "max_distance"),
        "proximity": _pair(settings.proximity, limits, "min_distance"),
    }


def _formulation(settings):
    if settings.formulation == "paper":
        return _control.Formulation.paper()
    formulation = _control.Formulation()
    formulation.leader_velocity = settings.feedforward
    formulation.obstacle_velocity = settings.collision.obstacle_velocity
    formulation.every_feature = settings.collision.gradient == "features"
    return formulation


def _pair(settings, limits, name):
    return {
        "limits": [getattr(limit, name) if limit else 0.0 for limit in limits],
        "margin": settings.margin,
        "alpha": settings.alpha,
    }


def _index_of(scenario, name):
    assistants = {scenario.agents[i].name: i for i in scenario.assistants}
    if name not in assistants:
        raise ValueError(
            f"agent: '{name}', allowed are the scenario's assistants: {', '.join(assistants)}"
        )
    return assistants[name]
