"""List, print, measure and publish topics, as rostopic does."""

from .command import EXAMPLES, configure, main

__all__ = ["EXAMPLES", "configure", "main"]
