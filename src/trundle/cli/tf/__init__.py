"""Look at transforms: print, draw and measure them, as tf's tools do."""

from .tf import EXAMPLES, configure, main

__all__ = ["EXAMPLES", "configure", "main"]
