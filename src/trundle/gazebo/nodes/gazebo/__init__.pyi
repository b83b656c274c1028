from .client import GazeboClient as GazeboClient
from .server import Gazebo as Gazebo
from .server import GazeboServer as GazeboServer
from .spawn_model import SpawnModel as SpawnModel
