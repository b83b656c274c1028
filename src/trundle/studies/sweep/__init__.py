"""Sweeps: many runs of a world with different values."""
