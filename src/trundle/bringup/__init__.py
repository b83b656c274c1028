"""The composition root: starts, paces and stops everything; alone knows everyone."""

from .check import CheckOutcome, check
from .launch import LaunchOptions, launch
from .outcome import Outcome
from .picture import picture_of
from .run import RunOptions, run
from .stage import load_simulation
from .view import ViewOptions, view

__all__ = [
    "CheckOutcome",
    "LaunchOptions",
    "Outcome",
    "RunOptions",
    "ViewOptions",
    "check",
    "launch",
    "load_simulation",
    "picture_of",
    "run",
    "view",
]
