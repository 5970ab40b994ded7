"""New scenarios from templates and from other scenarios."""
