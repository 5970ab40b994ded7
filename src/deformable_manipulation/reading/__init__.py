"""Typed reading of a scenario file, with all its mistakes at once."""
