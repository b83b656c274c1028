from .catalog import CONTROLLERS as CONTROLLERS
from .plugin import GazeboRosControl as GazeboRosControl
