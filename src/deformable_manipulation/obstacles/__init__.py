"""Kinds of obstacles: all that Python knows of each stands in a module of its own."""
