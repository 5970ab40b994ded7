"""Results of the validation as a Markdown page."""

from typing import Dict, List, Sequence

from deformable_manipulation.markdown.block import Provenance, render_block
from deformable_manipulation.validation.result import CaseResult, Check

HEADER = "| {} | theory | measured | error | tolerance | pass |\n|---|---|---|---|---|---|"
INTRODUCTION = """# Validation

This page compares the simulated rod and fabric with solutions of their theory. The solutions are
computed independently, with SciPy (`src/deformable_manipulation/validation/references/`). They are
the catenary, the elastica and the Kirchhoff rod as boundary value problems, small vibration by the
Rayleigh-Ritz method, large swings by Galerkin's method, and the exact equilibrium of rigid segments
and of meshes. This command writes the page:

```
scripts/validate
```

It exits with an error if a case misses its tolerance. `--help` lists its options. Unless stated
otherwise, the rod is the one of the paper: 2.25 m long, with a radius of 3.5 mm and a density of
1792.89 kg/m^3. It is simulated in steps of 10 ms with 2 substeps and the direct solver.
Percentages of L are of its length."""
ALL_PASS = "All {} comparisons are within their tolerance."
SOME_FAIL = "**{} of {} comparisons miss their tolerance.**"
SUMMARY_NOTE = """The table shows, for each kind of quantity, the comparison that comes closest to
its tolerance, and the number of comparisons. The sections below list all of them."""


def report(cases: Dict[str, CaseResult], images: Dict[str, str], provenance: Provenance) -> str:
    """Write the page: a summary of all cases, then every case with its figure and its table.

    images: link of the figure by name of the case, where it has one.
    provenance: of all numbers, which stand in a block.
    """
    checks = [check for case in cases.values() for check in case.checks]
    missed = sum(not check.passed for check in checks)
    verdict = SOME_FAIL.format(missed, len(checks)) if missed else ALL_PASS.format(len(checks))
    parts = ["## Summary", verdict, SUMMARY_NOTE, _summary(cases)]
    for name, case in cases.items():
        parts += [f"## {case.title}", case.method]
        if name in images:
            parts.append(f"![{case.title}]({images[name]})")
        parts.append(_table("quantity", case.checks))
    numbers = render_block("validation", "\n\n".join(parts), provenance)
    return f"{INTRODUCTION}\n\n{numbers}\n"


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
    """Error over tolerance; infinite if the check fails for any reason."""
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
