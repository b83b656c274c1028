from .driver import ArbotixDriver as ArbotixDriver
from .gripper_controller import GripperController as GripperController
