"""List, describe and call services, as rosservice does."""

from .command import EXAMPLES, configure, main

__all__ = ["EXAMPLES", "configure", "main"]
