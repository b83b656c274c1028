from .catalog import read_controllers as read_controllers
from .controller import Controller as Controller, ControllerSource as ControllerSource
from .joint_path import JointPath as JointPath, path_from_message as path_from_message, path_message as path_message
from .outcome import Outcome as Outcome
