"""What git knows about the code that was measured."""

import subprocess
from pathlib import Path
from typing import List, Optional, Sequence, Tuple


class HistoryError(RuntimeError):
    """Git is missing or refuses; its message is in the text."""


class History:
    """The commits of a checkout."""

    def __init__(self, checkout: Path) -> None:
        self._checkout = checkout

    @property
    def is_complete(self) -> bool:
        """Whether this is a checkout with all its commits, neither shallow nor exported."""
        try:
            top = self._git("rev-parse", "--show-toplevel")
            shallow = self._git("rev-parse", "--is-shallow-repository")
        except HistoryError:
            return False
        return shallow == "false" and Path(top).resolve() == self._checkout.resolve()

    def has(self, commit: str) -> bool:
        """Whether the history of the present commit contains another one."""
        try:
            self._git("merge-base", "--is-ancestor", commit, "HEAD")
        except HistoryError:
            return False
        return True

    def head(self) -> str:
        """The present commit, in short; "unknown" where there is no history."""
        try:
            return self._git("rev-parse", "--short=12", "HEAD")
        except HistoryError:
            return "unknown"

    def describe(self, commit: str) -> Tuple[str, str]:
        """Return a commit's short hash and its date.

        Raises:
            HistoryError: there is no such commit.
        """
        found = self._git("log", "-1", "--abbrev=12", "--format=%h %ad", "--date=short", commit)
        name, date = found.split()
        return name, date

    def change_since(self, commit: str, paths: Sequence[str]) -> Optional[str]:
        """Return the newest commit after ``commit`` that changed the paths; None: there is none."""
        found = self._git(
            "log", "-1", "--format=%h %ad %s", "--date=short", f"{commit}..HEAD", "--", *paths
        )
        return found or None

    def uncommitted(self, paths: Sequence[str]) -> List[str]:
        """Files among the paths that differ from the present commit."""
        lines = self._git("status", "--porcelain", "--", *paths).splitlines()
        return [line.split()[-1] for line in lines]

    def _git(self, *arguments: str) -> str:
        command = ["git", "-C", str(self._checkout), *arguments]
        try:
            ran = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True
            )
        except OSError as error:
            raise HistoryError(f"cannot run git: {error}") from error
        if ran.returncode:
            raise HistoryError(f"git {arguments[0]}: {ran.stderr.strip() or ran.returncode}")
        return ran.stdout.strip()
