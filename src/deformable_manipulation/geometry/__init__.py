"""Rotations, planes, polygons and meshes."""
