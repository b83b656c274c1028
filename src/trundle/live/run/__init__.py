"""`trundle run`: simulates one world, with its page, ROS interface and recording."""
