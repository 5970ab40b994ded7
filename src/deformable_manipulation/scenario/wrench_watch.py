"""The section ``controller.wrench_watch``: what force sensors may tell apart from the model."""

from dataclasses import dataclass

from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Number, Section


@dataclass(frozen=True)
class WrenchWatchSpec:
    """Limits of the difference between measured and modelled wrench at an assistant's grip."""

    max_force: float = parameter(
        Number("N", above=0.0, at_most=1e6), "Greatest difference of the forces, as a norm."
    )
    max_torque: float = parameter(
        Number("N m", above=0.0, at_most=1e6), "Greatest difference of the torques, as a norm."
    )
    patience: float = parameter(
        Number("s", at_least=0.0, at_most=60.0),
        "How long the difference has to last before the assistant stops. Raise it for noisy "
        "sensors and objects that swing.",
        default=0.3,
    )


WRENCH_WATCH = Section(WrenchWatchSpec)
