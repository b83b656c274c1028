"""Fixtures of a world behind /gazebo."""

from tests.gazebo_server import bare_gazebo as bare_gazebo, gazebo as gazebo
