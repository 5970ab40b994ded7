"""Collaborative manipulation of deformable objects with safe velocity controllers."""
