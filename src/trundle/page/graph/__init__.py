"""The ROS graph, as clients see it and call it."""
