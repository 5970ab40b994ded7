"""Extended class K functions: how fast a barrier may be approached."""

import numpy as np


class PiecewiseLinearClassK:
    """Extended class K-infinity function of two slopes (paper, section VI).

    ``alpha(h) = slopes[0] * h`` for h >= 0 and ``slopes[1] * h`` for h < 0. The first slope says
    how fast h may shrink while safe, the second how fast a violation has to be mended.

    Args:
        slopes: the two slopes [1/s], positive and finite.

    Raises:
        ValueError: a slope is not a positive finite number.
    """

    def __init__(self, slopes):
        above, below = (float(slope) for slope in slopes)
        if not (0.0 < above < np.inf and 0.0 < below < np.inf):
            raise ValueError(
                f"slopes: ({above}, {below}), allowed are two positive finite numbers [1/s]"
            )
        self.slopes = (above, below)

    def __call__(self, h):
        """alpha(h) [unit of h per second], of the shape of ``h``."""
        h = np.asarray(h, dtype=float)
        return np.where(h >= 0.0, self.slopes[0] * h, self.slopes[1] * h)
