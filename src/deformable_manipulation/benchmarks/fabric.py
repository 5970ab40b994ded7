"""The subject ``fabric``: substep with its memory, and other libraries."""

from typing import List

from deformable_manipulation.benchmarks.fabric_comparison import comparison_table
from deformable_manipulation.benchmarks.fabric_substep import substep_table
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Table


def measure_tables(request: Request) -> List[Table]:
    """Make all tables of the subject."""
    return [substep_table(request), comparison_table(request)]
