"""The environment of the other libraries: made when asked for, used by subprocesses only."""

import shutil
import subprocess
import sys
from pathlib import Path

NAME = ".venv-rivals"
REQUIREMENTS = Path("scripts") / "pip-requirements-rivals.txt"
INSTALL = "benchmark --install-rivals"


class InstallationError(RuntimeError):
    """The environment could not be made."""


def checkout() -> Path:
    """Top folder of the checkout that this file is in, or the current one where it is installed."""
    top = Path(__file__).resolve().parents[4]
    return top if (top / "package.xml").is_file() else Path.cwd()


def default_environment() -> Path:
    """Where the environment is, or would be."""
    return checkout() / NAME


def interpreter(environment: Path) -> Path:
    """Its Python; need not be there."""
    return environment / "bin" / "python3"


def install(environment: Path) -> None:
    """Make the environment, with what the requirements list. Raises InstallationError."""
    requirements = checkout() / REQUIREMENTS
    if not requirements.is_file():
        raise InstallationError(f"{requirements} is not there: run it in a checkout")
    _run([sys.executable, "-m", "venv", "--clear", str(environment)])
    pip = [str(interpreter(environment)), "-m", "pip", "--disable-pip-version-check"]
    try:
        _run(pip + ["install", "--requirement", str(requirements)])
    except InstallationError:
        shutil.rmtree(environment)  # half an environment would pass for one
        raise


def _run(command) -> None:
    try:
        done = subprocess.run(command, stdout=sys.stderr.fileno(), check=False)
    except OSError as error:
        raise InstallationError(str(error)) from error
    if done.returncode != 0:
        raise InstallationError(
            f"{' '.join(command)} ended with status {done.returncode}: the reason is above"
        )
