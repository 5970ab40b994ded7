"""Declared values as plain ones: what YAML and the parameter server hold."""

import dataclasses

from deformable_manipulation.reading.readers import Section


def plain(value):
    """Dicts, lists, strings, numbers and flags; None is ``auto``, and absent for a section."""
    if dataclasses.is_dataclass(value):
        return {
            field.name: plain(getattr(value, field.name))
            for field in dataclasses.fields(value)
            if not _is_absent(field, getattr(value, field.name))
        }
    if isinstance(value, tuple):
        return [plain(item) for item in value]
    return "auto" if value is None else value


def _is_absent(field: dataclasses.Field, value) -> bool:
    """Whether a section is not in use."""
    declaration = field.metadata.get("parameter")
    return value is None and declaration is not None and isinstance(declaration.reader, Section)
