"""Collaborative manipulation of deformable objects with safe velocity controllers.

The names in ``__all__`` are what programs that use the package need most. Each is loaded when it
is first used, so that importing one part of the package does not load the others.
"""

from importlib import import_module

_HOMES = {
    "ClosedLoop": "running.closed_loop",
    "MinimumDistance": "distance.minimum_distance",
    "Observation": "control.observation",
    "RunRecorder": "recording",
    "ScenarioError": "scenario",
    "TeamController": "control.team",
    "load_scenario": "scenario",
    "make_simulation": "simulation.factory",
    "scenario_from_mapping": "scenario",
    "scenario_to_mapping": "scenario",
}

__all__ = sorted(_HOMES)


def __getattr__(name):
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__():
    return sorted({*globals(), *_HOMES})
