"""ROS messages by package, only for annotations: message_types.pyi has the types."""
