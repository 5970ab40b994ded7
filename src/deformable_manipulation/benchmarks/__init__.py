"""Measured speed of the package's parts, beside other libraries on the same work."""
