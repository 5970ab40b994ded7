"""Limits of loads that the object exceeds at rest, before anybody has moved."""

from typing import List, Mapping

from deformable_manipulation.reading.errors import Problem, ScenarioError
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.spec import Scenario


def has_load_limits(scenario: Scenario) -> bool:
    """Whether a scenario limits what the object bears."""
    return any(BARRIERS[name].is_load for name in scenario.controller.barriers)


def find_overloads(starts: Mapping[str, Mapping[str, float]]) -> List[Problem]:
    """The limits of what the object bears that do not hold at the start.

    Args:
        starts: of each assistant, the lowest h of each barrier at the start, without margins.
    """
    problems = []
    for name in next(iter(starts.values()), {}):
        kind = BARRIERS[name]
        lowest = min(h[name] for h in starts.values())
        if kind.is_load and lowest < 0.0:
            text = (
                f"{kind.missed} at the start, by {kind.show(-lowest)} beyond the "
                "limit; loosen the limit, or change the object or where the agents start"
            )
            problems.append(Problem(f"controller.{name}", text))
    return problems


def refuse_overloads(starts: Mapping[str, Mapping[str, float]]) -> None:
    """Raise ScenarioError if there are any; see :func:`find_overloads`."""
    problems = find_overloads(starts)
    if problems:
        raise ScenarioError(problems)
