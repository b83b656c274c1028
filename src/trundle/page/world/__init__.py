"""Streams of the simulated world, which only our own client reads."""
