"""arbotix_python in its simulated mode, and the gripper of arbotix_controllers."""

from .driver import ArbotixDriver
from .gripper import GripperController

__all__ = ["ArbotixDriver", "GripperController"]
