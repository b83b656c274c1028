"""Sweeps: a world run many times with different values."""
