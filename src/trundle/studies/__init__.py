"""Worlds run many times: sweeps and datasets."""
