"""Campaigns: many random runs of a scenario, and their outcomes."""
