"""Campaigns: many random runs of a scenario, and what came of them."""
