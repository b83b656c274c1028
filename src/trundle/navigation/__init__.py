"""Stand-ins for the nodes of ROS' navigation: localization, mapping, planning, exploration, scans."""
