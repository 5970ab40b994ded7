"""Where numbers that are measured now come from."""

import datetime
from pathlib import Path
from typing import Sequence

from deformable_manipulation.figures.history import History, HistoryError
from deformable_manipulation.markdown.block import Provenance
from deformable_manipulation.recording.provenance import machine


def machine_name() -> str:
    """The processor and its number of usable cores."""
    here = machine()
    return "{}, {} cores".format(str(here["processor"]).replace(";", ","), here["cores"])


def present_origin(checkout: Path, command: str, sources: Sequence[str] = ()) -> Provenance:
    """Return the origin of numbers that ``command`` measures now.

    sources: paths that must not have uncommitted changes, or the commit would say too little.

    Raises:
        HistoryError: they have, or there is no history.
    """
    history = History(checkout)
    changed = history.uncommitted(sources) if sources else []
    if changed:
        raise HistoryError(f"commit your changes first: {', '.join(changed)}")
    date = datetime.date.today().isoformat()
    return Provenance(command, machine_name(), history.head(), date)
