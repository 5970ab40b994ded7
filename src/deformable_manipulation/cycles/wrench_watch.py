"""Compares the wrenches that force sensors measure with those of the model."""

from dataclasses import dataclass
from typing import Dict, Optional, Tuple

import numpy as np

_REMEDY = "look what it touches or has lost, then enable it"


@dataclass
class _Grip:
    """What is known of an assistant's grip."""

    stamp: Optional[float] = None  # s, of the newest measurement
    wrench: Tuple[np.ndarray, np.ndarray] = (np.zeros(3), np.zeros(3))  # N, N m
    problem: str = ""  # with that measurement
    since: Optional[float] = None  # s, from when on the difference is too large
    stopped: str = ""  # why, until it is enabled again


class WrenchWatch:
    """Stops an assistant whose grip bears something else than the model says, for some time.

    Both wrenches are those that the object exerts on the agent, in the fixed frame, about the held
    point.

    Args:
        settings: :class:`~deformable_manipulation.scenario.wrench_watch.WrenchWatchSpec`.
        names: of the assistants.
        timeout: age [s] at which a measurement counts as lost.
    """

    def __init__(self, settings, names, timeout: float):
        self._settings = settings
        self._timeout = timeout
        self._grips: Dict[str, _Grip] = {name: _Grip() for name in names}

    def measured(self, name: str, stamp: float, force, torque, problem: str = "") -> None:
        """Take in a measurement of an assistant's grip.

        Args:
            name: of the assistant.
            stamp: time of the measurement [s], by the clock of the states.
            force: (3,) [N].
            torque: (3,) [N m].
            problem: a clause that says why it cannot be used, such as its frame; empty: it can.
        """
        grip = self._grips[name]
        if grip.stamp is not None and grip.stamp - self._timeout < stamp <= grip.stamp:
            return  # out of order; much older ones are after a reset
        grip.stamp = stamp
        grip.wrench = np.array(force, dtype=float), np.array(torque, dtype=float)
        finite = all(np.isfinite(part).all() for part in grip.wrench)
        grip.problem = problem or ("" if finite else "holds a number that is not finite")

    def check(self, name: str, time: float, modelled: np.ndarray) -> str:
        """A clause that says why the assistant has to stand still; empty: it need not.

        Args:
            name: of the assistant.
            time: [s] of the state.
            modelled: (6,) force [N] and torque [N m] in that state.
        """
        grip = self._grips[name]
        if grip.stopped:
            return grip.stopped
        if grip.stamp is None:
            return f"no measured wrench of {name} yet"
        if abs(time - grip.stamp) > self._timeout:
            return f"the measured wrench of {name} is {abs(time - grip.stamp):.1f} s off the state"
        if grip.problem:
            return f"the measured wrench of {name} {grip.problem}"
        excess = self._excess(grip, modelled)
        if not excess:
            grip.since = None
            return ""
        if grip.since is None or grip.since > time:
            grip.since = time
        if time - grip.since < self._settings.patience:
            return ""
        grip.stopped = f"{excess} at the grip of {name}: {_REMEDY}"
        return grip.stopped

    def _excess(self, grip: _Grip, modelled: np.ndarray) -> str:
        """A clause that names the difference that is too large, if one is."""
        limits = self._settings.max_force, self._settings.max_torque
        parts = zip(("force", "torque"), ("N", "N m"), grip.wrench, np.split(modelled, 2), limits)
        for kind, unit, seen, expected, limit in parts:
            difference = float(np.linalg.norm(seen - expected))
            if difference > limit:
                return (
                    f"the measured {kind} differs from the modelled one by {difference:.3g} "
                    f"{unit}, more than {limit:g} {unit},"
                )
        return ""

    def rearm(self, name: str) -> None:
        """Let a stopped assistant go on, if the difference is gone."""
        self._grips[name].stopped = ""
        self._grips[name].since = None

    def reset(self) -> None:
        """Forget everything, for another run."""
        self._grips = {name: _Grip() for name in self._grips}
