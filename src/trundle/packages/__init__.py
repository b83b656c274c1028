"""Where files live: ROS packages, Gazebo models, worlds and what their URIs mean."""

from .manifest import needs
from .model_config import model_file, refuse_template
from .packages import ALLOW_OUTSIDE, Packages

__all__ = ["ALLOW_OUTSIDE", "Packages", "model_file", "needs", "refuse_template"]
