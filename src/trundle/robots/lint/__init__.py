"""Lint of descriptions without an engine: valid input that is most likely a mistake."""
