"""Obstacles as they are seen while a run goes on: cameras, and what is made of their points."""
