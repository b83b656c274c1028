"""Stepping of a compiled world, and access to its state."""
