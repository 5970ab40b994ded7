"""Runs a command by its name: ``python3 -m deformable_manipulation.commands NAME ARGUMENTS``."""

import sys

from deformable_manipulation.commands.guard import run_command

if __name__ == "__main__":
    sys.exit(run_command(sys.argv[1], sys.argv[2:]))
