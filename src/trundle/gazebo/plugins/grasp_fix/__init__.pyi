from .plugin import GraspFix as GraspFix
