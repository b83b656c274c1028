"""Print, draw and measure transforms, as tf's tools do."""

from .command import EXAMPLES, configure, main

__all__ = ["EXAMPLES", "configure", "main"]
