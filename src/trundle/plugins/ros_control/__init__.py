"""ros_control: joints behind transmissions, and the controllers that drive them."""

from .catalog import CONTROLLERS
from .plugin import GazeboRosControl

__all__ = ["CONTROLLERS", "GazeboRosControl"]
