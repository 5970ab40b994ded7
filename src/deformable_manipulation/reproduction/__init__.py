"""The paper's experiments again: runs, figures and tables in one report."""
