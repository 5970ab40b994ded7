"""Reproduction of the paper's experiments: runs, figures and tables in one report."""
