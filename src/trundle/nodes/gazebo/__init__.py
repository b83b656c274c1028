"""gazebo_ros in this process: the node /gazebo with its services and topics, spawn_model, and the window."""

from .client import GazeboClient
from .server import Gazebo, GazeboServer
from .spawn_model import SpawnModel

__all__ = ["Gazebo", "GazeboClient", "GazeboServer", "SpawnModel"]
