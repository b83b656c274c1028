"""Profile of a running simulation: where its wall time goes."""
