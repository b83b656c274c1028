"""The ROS master with its parameter server."""
