"""How a command tells that it failed."""

import sys


def fail(command: str, message: str) -> int:
    """Print what went wrong; returns the exit status."""
    print(f"{command}: {message}", file=sys.stderr)
    return 1
