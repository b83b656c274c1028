"""Stand-ins for the nodes of ROS' navigation: one room each for what localizes, maps, plans and drives."""
