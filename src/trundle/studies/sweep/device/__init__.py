"""Execution of a sweep's rows on a GPU, which steps them together."""
