"""The composition root: starts, paces and stops everything; alone knows everyone."""

from .launch import LaunchOptions, launch
from .outcome import Outcome
from .run import RunOptions, run
from .view import ViewOptions, view

__all__ = ["LaunchOptions", "Outcome", "RunOptions", "ViewOptions", "launch", "run", "view"]
