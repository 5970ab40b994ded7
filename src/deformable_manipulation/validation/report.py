"""Results of the validation as a Markdown page."""

from typing import Dict, List, Sequence

from deformable_manipulation.validation.result import CaseResult, Check

HEADER = "| {} | theory | measured | error | tolerance | pass |\n|---|---|---|---|---|---|"
INTRODUCTION = """# Validation

The simulated rod and fabric against solutions of their theory that are computed independently, with
SciPy (`src/deformable_manipulation/validation/references/`): the catenary, the elastica and the
Kirchhoff rod as boundary value problems, small vibration by Rayleigh-Ritz, large swings by
Galerkin's method, and the exact equilibrium of rigid segments and of meshes. Written by

```
scripts/validate
```

which exits with an error where a case misses its tolerance; `--help` tells more. The rod is the
paper's, 2.25 m long, of radius 3.5 mm and 1792.89 kg/m^3, in steps of 10 ms with 2 substeps and the
direct solver, where nothing else is said. Percentages of L are of its length."""
ALL_PASS = "All {} comparisons are within their tolerance."
SOME_FAIL = "**{} of {} comparisons miss their tolerance.**"
SUMMARY_NOTE = """Of each kind of quantity, the comparison that comes nearest to its tolerance, and
how many there are; all are listed below."""


def report(cases: Dict[str, CaseResult], images: Dict[str, str]) -> str:
    """Write the page: a summary of all cases, then every case with its figure and its table.

    images: link of the figure by name of the case, where it has one.
    """
    checks = [check for case in cases.values() for check in case.checks]
    missed = sum(not check.passed for check in checks)
    verdict = SOME_FAIL.format(missed, len(checks)) if missed else ALL_PASS.format(len(checks))
    parts = [INTRODUCTION, "## Summary", verdict, SUMMARY_NOTE, _summary(cases)]
    for name, case in cases.items():
        parts += [f"## {case.title}", case.method]
        if name in images:
            parts.append(f"![{case.title}]({images[name]})")
        parts.append(_table("quantity", case.checks))
    return "\n\n".join(parts) + "\n"


def _summary(cases: Dict[str, CaseResult]) -> str:
    lines = [HEADER.format("quantity (the worst of each kind)")]
    for name, case in cases.items():
        kinds: Dict[str, List[Check]] = {}
        for check in case.checks:
            kinds.setdefault(check.quantity.split(",")[0], []).append(check)
        for checks in kinds.values():
            worst = max(checks, key=_nearness)
            number = f" (of {len(checks)})" if len(checks) > 1 else ""
            lines.append(_row(f"**{name}**: {worst.quantity}{number}", worst))
    return "\n".join(lines)


def _nearness(check: Check) -> float:
    """Error over tolerance; infinite where the check fails for any reason."""
    return check.error / check.tolerance if check.passed else float("inf")


def _table(title: str, checks: Sequence[Check]) -> str:
    return "\n".join([HEADER.format(title), *(_row(check.quantity, check) for check in checks)])


def _row(title: str, check: Check) -> str:
    theory = "" if check.theory is None else _with_unit(check.theory, check.unit)
    cells = [
        title,
        theory,
        _with_unit(check.measured, check.unit),
        _with_unit(check.error, check.error_unit, 2),
        _with_unit(check.tolerance, check.error_unit, 2),
        "yes" if check.passed else "**no**",
    ]
    return "| " + " | ".join(cells) + " |"


def _with_unit(value: float, unit: str, digits: int = 5) -> str:
    return f"{value:.{digits}g} {unit}".strip()
