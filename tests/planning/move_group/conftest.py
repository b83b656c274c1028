"""A graph with move_group, an arm of six joints and its gripper."""

from tests.gazebo.nodes.conftest import graph as graph, messages as messages
