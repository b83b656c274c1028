"""Fixtures of a world behind /gazebo."""

from tests.gazebo_server import bare_gazebo as bare_gazebo
from tests.gazebo_server import gazebo as gazebo
