"""The simulated object of a scenario, and observations of it."""
