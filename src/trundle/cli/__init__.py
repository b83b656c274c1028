"""The `trundle` command: arguments in, exit code out.

Only the module of the command asked for is imported, so that `trundle topic list` answers at once.
"""

from .main import main

__all__ = ["main"]
