"""The true object of a run: this package's simulation, or another engine's."""
