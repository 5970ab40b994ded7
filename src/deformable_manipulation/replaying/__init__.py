"""Recordings of real objects, and how well a simulated object follows them."""
