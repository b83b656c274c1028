"""libgazebo_grasp_fix.so: what fingers hold is welded to the palm while they hold it."""

from .plugin import GraspFix

__all__ = ["GraspFix"]
