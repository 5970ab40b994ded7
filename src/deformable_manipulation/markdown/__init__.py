"""Markdown pages: tables, and blocks that commands write."""
