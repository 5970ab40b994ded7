"""Checked values as a YAML file holds them."""

import dataclasses


def to_plain(value):
    """Dataclasses as dicts, tuples as lists, None as ``auto``; all else as it is."""
    if dataclasses.is_dataclass(value):
        return {f.name: to_plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, tuple):
        return [to_plain(item) for item in value]
    return "auto" if value is None else value
