"""The cases of the validation, by name; each is a function of ``quick`` that runs it."""

from typing import Callable, Dict

from deformable_manipulation.validation.cases import (
    cantilever,
    convergence,
    fabric_gradients,
    fabrics,
    free,
    grips,
    hanging,
    holds,
    motion,
    natural_shape,
    point_masses,
    spatial,
    twist,
    viscosity,
    wrenches,
)
from deformable_manipulation.validation.result import CaseResult, Check

CASES: Dict[str, Callable[[bool], CaseResult]] = {
    "hanging": hanging.run,
    "cantilever": cantilever.run,
    "spatial": spatial.run,
    "twist": twist.run,
    "free": free.run,
    "holds": holds.run,
    "grips": grips.run,
    "convergence": convergence.run,
    "motion": motion.run,
    "viscosity": viscosity.run,
    "natural_shape": natural_shape.run,
    "point_masses": point_masses.run,
    "wrenches": wrenches.run,
    "fabrics": fabrics.run,
    "fabric_gradients": fabric_gradients.run,
}


def run_case(name: str, quick: bool) -> CaseResult:
    """Run a case; one that cannot be brought to rest is a result that does not pass."""
    try:
        return CASES[name](quick)
    except RuntimeError as error:
        failure = Check(f"could not be run: {error}", None, float("nan"), "", float("inf"), 0.0, "")
        return CaseResult(name.capitalize(), "", [failure])
