"""ROS 1's Python packages for programs that import them: rospy, genpy, messages, and what stands on them.

`modules/` holds the packages, `finder` makes them importable, `environment` puts the finder into child processes.
Nothing is imported here: the finder is loaded at the start of every Python process.
"""
