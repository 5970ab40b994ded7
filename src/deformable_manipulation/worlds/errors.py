"""Why there is no such world."""


class WorldError(ValueError):
    """A scenario cannot be run in the world that it asks for; the text says why and what to do."""
