from .driver import ArbotixDriver as ArbotixDriver
from .gripper import GripperController as GripperController
