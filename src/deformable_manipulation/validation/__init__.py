"""The simulation of rods and fabrics held against independent solutions of their theory."""
