"""What an identification found, in words and as an ``object`` section."""

import math
from typing import Dict, Iterator, List, Sequence, Tuple

import yaml

from deformable_manipulation.identification.identify import Identification
from deformable_manipulation.identification.material_parameters import RANGES
from deformable_manipulation.markdown.table import millimetres, table
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.objects.spec import ObjectSpec

_UNITS = {
    "young_modulus": "Pa",
    "torsion_modulus": "Pa",
    "bending_retardation_time": "s",
    "drag_coefficient": "",
    "damping": "1/s",
    "stretching_compliance": "m/N",
    "bending_compliance": "1/(N m)",
}
_VAGUE_FACTOR = 0.5  # standard deviation of a logarithm, from which on a value is not told
_VAGUE_ANGLE = math.radians(5.0)
_TORSION_MATTERS = 0.1  # relative change of the mean distance
_CURVATURE_MATTERS = 0.1  # likewise
_ANOTHER_CLIP = 1.5  # times the error inside, from which on the fit does not carry over


def values(found: Identification) -> List[List[str]]:
    """Rows of name, value, standard deviation."""
    return [
        [name, _value(name, number), _spread(name, deviation, at_bound)]
        for name, number, deviation, at_bound in _found(found)
    ]


def _found(found: Identification) -> Iterator[Tuple[str, float, float, bool]]:
    """Of each parameter its name, number, deviation, and whether it lies at a bound."""
    at_bounds = found.parameters.at_bounds(found.fit.vector).tolist()
    yield from zip(found.parameters.names, found.fit.vector, found.fit.deviations, at_bounds)


def _value(name: str, number: float) -> str:
    if name in RANGES:
        return f"{math.exp(number):.4g} {_UNITS[name]}".strip()
    if name.startswith("natural"):
        return f"{number:.3f} 1/m"
    return f"{math.degrees(number):.2f} deg"


def _spread(name: str, deviation: float, at_bound: bool) -> str:
    if at_bound:
        return "at the bound of the search"
    if math.isnan(deviation):
        return "not known"
    if name.startswith("natural"):
        return f"+- {deviation:.3f} 1/m"
    percent, degrees = 100.0 * deviation, math.degrees(deviation)
    return f"+- {percent:.1f} %" if name in RANGES else f"+- {degrees:.2f} deg"


def statements(found: Identification) -> Iterator[str]:
    """What to know before the values are used."""
    yield _about_mass(found.parameters.object_of(found.fit.vector))
    for name, number, deviation, at_bound in _found(found):
        if at_bound:
            yield (
                f"The value of {name}, {_value(name, number)}, is the bound of the search and no "
                "result: the data do not tell it, or something else is wrong, such as what the "
                "grippers hold."
            )
            continue
        if math.isnan(deviation):
            continue
        if name in RANGES and deviation > _VAGUE_FACTOR:
            low, high = (math.exp(number + sign * 2.0 * deviation) for sign in (-1, 1))
            unit = _UNITS[name]
            yield f"The data do not tell {name}: {low:.2g} to {high:.2g} {unit} suit as well."
        elif name.startswith("aim") and deviation > _VAGUE_ANGLE:
            degrees = math.degrees(deviation)
            yield f"The data do not tell the {name}: its deviation is {degrees:.0f} deg."
    if any(math.isnan(deviation) for deviation in found.fit.deviations):
        yield "Too few windows for standard deviations: record more, or use a shorter --window."
    if found.torsion is not None and "torsion_modulus" not in found.parameters.material:
        yield _about_torsion(found.torsion)
    if found.straight is not None:
        yield _about_curvature(found.straight)
    if not found.fit.converged:
        yield "The search was stopped before it came to rest: start from object.yaml once more."
    if found.left_out is not None:
        yield _about_validation(*found.left_out)


def _about_mass(spec: ObjectSpec) -> str:
    if isinstance(spec, RodSpec):
        return (
            "Shapes without forces tell the ratio of bending stiffness and mass only: "
            f"E I / (rho A) = {spec.stiffness_over_mass:.4g} m^4/s^2. With another density, change "
            "young_modulus in proportion."
        )
    return (
        "Shapes without forces tell the products of compliances and mass only. With another "
        "density, change both compliances in inverse proportion."
    )


def _about_torsion(changes: Sequence[float]) -> str:
    less, more = (f"{100.0 * change:+.1f} %" for change in changes)
    told = max(abs(change) for change in changes) > _TORSION_MATTERS
    return (
        f"A third of the torsion modulus changes the mean distance by {less}, three times as much "
        f"by {more}: the data {'tell' if told else 'do not tell'} torsion, which was not fitted."
    )


def _about_curvature(change: float) -> str:
    verdict = (
        "keep it"
        if change > _CURVATURE_MATTERS
        else "leave natural_curvature out, the rope is as good as straight"
    )
    return (
        "Without natural curvature, and all else fitted anew, the mean distance changes by "
        f"{100.0 * change:+.1f} %: {verdict}."
    )


def _about_validation(left_out: float, inside: float) -> str:
    carries = left_out <= _ANOTHER_CLIP * inside
    return (
        f"Cross-validation: {millimetres(left_out, 2)} mm per coordinate on recordings that were "
        f"left out, {millimetres(inside, 2)} mm on those in the fit"
        + ("." if carries else ": the values do not carry over to other motions; record more.")
    )


def object_section(found: Identification) -> str:
    """The object with the values found, as YAML; deviations and the grips' aim in comments."""
    spec = found.parameters.object_of(found.fit.vector)
    lines = ["# Identified from recordings; standard deviations:"]
    lines += [f"#   {name}: {value} {spread}" for name, value, spread in values(found)]
    mapping = {"object": _rounded(spec.to_mapping())}
    text = yaml.safe_dump(mapping, sort_keys=False, default_flow_style=None)
    return "\n".join(lines) + "\n" + text


def _rounded(mapping: Dict) -> Dict:
    return {
        key: float(f"{value:.6g}") if isinstance(value, float) else value
        for key, value in mapping.items()
    }


def report(found: Identification, recordings: Sequence[str], windows: int) -> str:
    """A page in Markdown."""
    errors = [
        [name.replace("_", " "), millimetres(value, 2) or "nothing to compare"]
        for name, value in found.errors.items()
        if not math.isnan(value)
    ]
    parts = [
        "# Identification",
        f"{len(recordings)} recordings, replayed in {windows} windows.",
        table(("parameter", "value", "standard deviation"), values(found)),
        table(("difference", "mm"), errors),
        "\n".join(f"- {sentence}" for sentence in statements(found)),
        "Recordings:",
        "\n".join(f"- {name}" for name in recordings),
    ]
    return "\n\n".join(parts) + "\n"
