"""The native controller's parameters from a scenario."""

from itertools import combinations

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.scenario import pair_limits


def native_parameters(scenario, names, safety):
    """What ``_control.TeamController`` is made of.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        names: of the assistants that it commands.
        safety: False leaves the barriers out.

    Raises:
        ValueError: the scenario has no assistant of a name, or the solver is not installed.
    """
    settings = scenario.controller
    commanded, leader = [_index_of(scenario, name) for name in names], scenario.leader_index
    starts = np.array([each.start for each in scenario.agents], dtype=float)
    return {
        "commanded": commanded,
        "leader": leader,
        "assistants": list(scenario.assistants),
        "references": list(starts[commanded] - starts[leader]),
        "cycle_time": scenario.cycle_time,
        "gain": settings.gain,
        "weights": settings.weights,
        "max_velocity": settings.max_velocity,
        "max_acceleration": settings.max_acceleration,
        "smoothing": settings.smoothing,
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
        "overstretch": _pair(settings.overstretch, scenario, "max_distance"),
        "proximity": _pair(settings.proximity, scenario, "min_distance"),
    }


def _formulation(settings):
    if settings.formulation == "paper":
        return _control.Formulation.paper()
    formulation = _control.Formulation()
    formulation.leader_velocity = settings.feedforward
    formulation.obstacle_velocity = settings.collision.obstacle_velocity
    formulation.every_feature = settings.collision.gradient == "features"
    return formulation


def _pair(settings, scenario, name):
    limits = np.zeros((len(scenario.agents), len(scenario.agents)))
    for i, j in combinations(range(len(limits)), 2):
        limits[i, j] = limits[j, i] = getattr(pair_limits(scenario, i, j), name)
    return {
        "limits": limits,
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
