"""Streams of the simulated world, for Trundle's own client."""
