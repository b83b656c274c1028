"""Rows of a sweep that a GPU steps together."""
