"""Recorded messages, played as a graph's."""
