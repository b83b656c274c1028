"""Base exception."""


class ROSLibException(Exception):
    """Base class."""
