"""The simulated object of a scenario, and what is to be seen of it."""
