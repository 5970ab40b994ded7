"""The simulation of rods held against independent solutions of rod theory."""
