"""The ROS graph for clients: topics, services and parameters."""
