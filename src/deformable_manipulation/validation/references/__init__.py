"""Independent solutions of rod theory, written with SciPy; nothing here uses the simulation."""
