"""Whether an object is as long as its material makes it, or was torn beyond what is simulated."""

from typing import Optional

import numpy as np

# Ropes and rods yield less than a thousandth to any load in use; what is longer has been pulled
# apart, and its shape and distances mean nothing.
LARGEST_VALID_STRETCH = 0.01


def rod_stretch(points: np.ndarray, segment_length: float) -> float:
    """The relative change of length of the segment that is changed most, with its sign [1].

    :param points: (P, 3) segment ends [m].
    :param segment_length: of an undeformed segment [m].
    """
    edges = np.diff(points, axis=0)
    changes = np.sqrt(np.einsum("pi,pi->p", edges, edges)) / segment_length - 1.0
    return float(changes[np.argmax(np.abs(changes))])


def largest_stretch(stretches: np.ndarray) -> Optional[float]:
    """The largest size of the changes of length of a run [1], None where there is none."""
    finite = stretches[np.isfinite(stretches)]
    return float(np.abs(finite).max()) if finite.size else None
