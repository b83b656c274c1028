"""Arms that plan: the robot with its groups, kinematics, the scene around it, ways without collision, move_group."""
