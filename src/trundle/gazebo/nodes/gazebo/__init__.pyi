from .client import GazeboClient as GazeboClient
from .server import Gazebo as Gazebo, GazeboServer as GazeboServer
from .spawn_model import SpawnModel as SpawnModel
