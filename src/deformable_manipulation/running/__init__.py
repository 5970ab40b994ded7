"""The whole chain in one process, with exact or imperfect knowledge."""
