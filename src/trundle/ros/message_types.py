"""ROS messages by package, for annotations alone: the types are in message_types.pyi."""
