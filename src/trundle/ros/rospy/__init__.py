"""ROS 1's Python packages for programs that import them: rospy, genpy, messages, and packages that build on them.

`modules/` holds the packages, `finder` makes them importable, `environment` installs the finder in child processes.
Nothing is imported here: the finder is loaded at the start of every Python process.
"""
