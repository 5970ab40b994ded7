"""How sure a fraction of random runs is."""

from typing import Tuple

from scipy.stats import beta

LEVEL = 0.95


def interval(count: int, total: int) -> Tuple[float, float]:
    """Exact confidence interval of a probability (Clopper and Pearson, 1934).

    It holds the true probability in at least 95 of 100 campaigns, whatever that is.

    Args:
        count: runs in which it happened, of ``total`` > 0.
    """
    tail = 0.5 * (1.0 - LEVEL)
    low = float(beta.ppf(tail, count, total - count + 1)) if count else 0.0
    high = float(beta.ppf(1.0 - tail, count + 1, total - count)) if count < total else 1.0
    return low, high
