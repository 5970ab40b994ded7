"""Pictures and videos of a run, from what was rendered."""
