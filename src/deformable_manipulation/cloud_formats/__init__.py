"""Formats of files of points: bytes to coordinates."""
