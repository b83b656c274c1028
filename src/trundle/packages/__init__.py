"""Where files live: ROS packages, Gazebo models, worlds and what their URIs mean."""

from .model_config import model_file
from .packages import Packages

__all__ = ["Packages", "model_file"]
