"""A graph with the stand-ins that a test starts."""

from tests.gazebo.nodes.conftest import graph as graph, messages as messages
