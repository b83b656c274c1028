"""Internals that tools import."""
