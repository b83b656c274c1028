"""Lint of descriptions, without an engine: legal input that is most likely a mistake."""
