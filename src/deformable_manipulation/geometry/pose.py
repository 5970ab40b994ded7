"""Places and orientations as plain immutable data."""

from typing import Tuple

Vector = Tuple[float, float, float]
Quaternion = Tuple[float, float, float, float]  # x, y, z, w
