"""A controller's parameters changed while it runs (dynamic_reconfigure)."""

import copy
import math

import rospy
from dynamic_reconfigure.encoding import extract_params
from dynamic_reconfigure.server import Server

from deformable_manipulation.cfg import ControllerConfig
from deformable_manipulation.scenario import ScenarioError, controller_to_mapping, with_controller
from deformable_manipulation.scenario.live import live_parameters

_AUTO = -1.0  # where the scenario says auto
_ALL = -1  # level of the first call


def _key_paths():
    """Name in dynamic_reconfigure -> key path in the scenario's section ``controller``."""
    paths = {}
    for path, declaration in live_parameters():
        names = declaration.live.names
        for index, name in enumerate(names):
            paths[name] = path if len(names) == 1 else (*path, index)
    return paths


KEYS = _key_paths()


def values_of(scenario):
    """The live parameters of a scenario, by name."""
    section = controller_to_mapping(scenario)
    values = {}
    for name, path in KEYS.items():
        value = section
        for key in path:
            value = value[key]
        values[name] = _AUTO if value == "auto" else value
    return values


def changed(scenario, values):
    """A scenario with some live parameters replaced, checked as a file would be.

    Raises:
        ScenarioError: they cannot be used.
    """
    section = controller_to_mapping(scenario)
    for name, value in values.items():
        *parents, last = KEYS[name]
        place = section
        for key in parents:
            place = place[key]
        place[last] = "auto" if value == _AUTO else value
    return with_controller(scenario, section)


class _UnclampedServer(Server):
    """A server that hands on values beyond their range, so that they can be refused."""

    def _clamp(self, config):
        pass


class LiveParameters:
    """Offers a controller's parameters on ``<name>/set_parameters``, first the scenario's values.

    Changes are checked together; those that are out of range, or do not go with each other or with
    the object, are refused as a whole, with the reason in the parameter ``outcome`` and in the log.

    Args:
        scenario: the checked scenario.
        name: of the assistant, or of several under one controller.
        apply: called with a changed scenario; what it raises as ValueError refuses it, too.
    """

    def __init__(self, scenario, name, apply):
        self._scenario = scenario
        self._apply = apply
        _widen_ranges(values_of(scenario))
        self._server = _UnclampedServer(ControllerConfig, self._change, rospy.resolve_name(name))

    def _change(self, config, level):
        present = values_of(self._scenario)
        if level == _ALL:  # what an earlier life of the node has left behind does not count
            return _filled(config, present, "As in the scenario.")
        wanted = {name: config[name] for name in KEYS if config[name] != present[name]}
        try:
            _check_ranges(wanted, present)
            scenario = changed(self._scenario, wanted)
            self._apply(scenario)
        except ValueError as error:
            outcome = "Nothing changed: " + _reason(error)
            rospy.logerr(outcome)
            return _filled(config, present, outcome)
        self._scenario = scenario
        return _filled(config, values_of(scenario), "Changed: " + (", ".join(wanted) or "nothing"))


def _filled(config, values, outcome):
    config = copy.copy(config)
    config.update(values, outcome=outcome)
    return config


def _check_ranges(wanted, present):
    """Raises ValueError with all values that are out of the range that their sliders have."""
    faults = []
    for name, value in wanted.items():
        least, most = ControllerConfig.min[name], ControllerConfig.max[name]
        if not (_is_finite(value) and least <= value <= most):
            faults.append(
                f"{name} must be a number from {least:g} to {most:g}, not {value};"
                f" it stays {present[name]:g}"
            )
    if faults:
        raise ValueError(". ".join(faults) + ".")


def _is_finite(value):
    return isinstance(value, (int, float)) and math.isfinite(value)


def _reason(error):
    if isinstance(error, ScenarioError):
        return "; ".join(map(str, error.problems))
    return str(error)


def _widen_ranges(values):
    """Ranges of the parameters hold the scenario's values: what is beyond them would be clamped."""
    for parameter in extract_params(ControllerConfig.config_description):
        name = parameter["name"]
        if name in values:
            parameter["min"] = ControllerConfig.min[name] = min(parameter["min"], values[name])
            parameter["max"] = ControllerConfig.max[name] = max(parameter["max"], values[name])
