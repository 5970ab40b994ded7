"""Measured numbers in the documentation: who measured them, when, and whether they are stale."""
