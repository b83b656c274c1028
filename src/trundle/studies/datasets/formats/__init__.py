"""Formats of datasets, a file each."""
