"""Lengths in words."""


def millimetres(metres: float) -> str:
    """A length in mm with as many digits as matter: 0.1 mm below 100 mm, no useless zero."""
    length = 1e3 * metres
    return f"{round(length, 1 if abs(length) < 100.0 else None):g} mm"
