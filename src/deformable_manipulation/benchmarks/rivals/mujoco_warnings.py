"""What MuJoCo warns of."""

import mujoco

from deformable_manipulation.benchmarks.trial import TrialError


def require_stable(data: mujoco.MjData) -> None:
    """Raise TrialError where the simulation has broken down, which the library only logs."""
    if any(warning.number for warning in data.warning):
        raise TrialError("MuJoCo warns that the simulation is unstable")
