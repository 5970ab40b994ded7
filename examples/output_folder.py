"""Where the examples put what they make."""

import argparse
import tempfile
from pathlib import Path


def output_folder(description: str) -> Path:
    """The folder named on the command line, or a temporary one; it is made and told."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("folder", nargs="?", help="for what is made (default: a temporary one)")
    name = parser.parse_args().folder or tempfile.mkdtemp(prefix="deformable_manipulation_")
    folder = Path(name)
    folder.mkdir(parents=True, exist_ok=True)
    print(f"The files of this example are in {folder}")
    return folder
