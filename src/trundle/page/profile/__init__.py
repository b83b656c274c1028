"""Profile of a running simulation: the wall time of its parts."""
