"""The section ``correction``: how measured points of the object correct its model."""

from dataclasses import dataclass
from typing import Optional

from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Flag, Number, Report, Section


@dataclass(frozen=True)
class CorrectionSpec:
    """How measured points of the object correct its model."""

    noise: float = parameter(
        Number("m", above=0.0, at_most=1.0),
        "Standard deviation of each coordinate of a measured point. Raise it if the correction "
        "follows noise, and for points whose errors go together.",
        default=0.005,
        native=True,
    )
    expected: float = parameter(
        Number("m", above=0.0, at_most=1.0),
        "How far the model is from the object, usually, where it is farthest. Points that are "
        "farther off than four times this, together with the noise and what is known already, are "
        "left out.",
        default=0.02,
        native=True,
    )
    fading_time: float = parameter(
        Number("s", above=0.0, at_most=1e4),
        "Time constant with which the correction fades when nothing is measured. Lower it for "
        "objects whose error changes quickly.",
        default=20.0,
        native=True,
    )
    smoothing: float = parameter(
        Number("s", at_least=0.0, at_most=10.0),
        "Time constant with which the shape follows what is estimated, so that distances do not "
        "jump. Raise it if commands shake.",
        default=0.5,
        native=True,
    )
    limit: float = parameter(
        Number("m", above=0.0, at_most=10.0),
        "Largest correction with which model and measurement count as agreeing. They disagree, "
        "too, if most points are left out.",
        default=0.1,
        native=True,
    )
    stop: bool = parameter(
        Flag(),
        "Whether the assistants stop while model and measurement disagree.",
        default=False,
        native=True,
    )


CORRECTION = Section(CorrectionSpec)


def check_correction(report: Report, spec, correction: Optional[CorrectionSpec]) -> None:
    """Only lines are corrected.

    Args:
        spec: the object.
    """
    if correction is not None and spec.is_surface:
        report.add(("correction",), "applies only to rods; remove it")


def check_measured_points(report: Report, knowledge, correction: Optional[CorrectionSpec]) -> None:
    """What a camera sees must be of use."""
    if knowledge.camera_rate > 0.0 and correction is None:
        report.add(
            ("knowledge", "camera_rate"),
            "has no effect without a section `correction`; add one, such as `correction: {}`",
        )
