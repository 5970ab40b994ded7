"""The subject ``rod``: substep, equilibrium with gradient, and other libraries."""

from typing import List

from deformable_manipulation.benchmarks.rod_comparison import comparison_table
from deformable_manipulation.benchmarks.rod_equilibrium import equilibrium_table
from deformable_manipulation.benchmarks.rod_substep import substep_table
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Table

TABLES = (substep_table, equilibrium_table, comparison_table)


def measure_tables(request: Request) -> List[Table]:
    """Make all tables of the subject."""
    return [table(request) for table in TABLES]
