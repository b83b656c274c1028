"""The `trundle` command: arguments in, exit code out.

Only the requested command's module is imported, so that `trundle topic list` starts fast.
"""

from .main import main

__all__ = ["main"]
