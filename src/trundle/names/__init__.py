"""ROS names: legality, resolution, remapping arguments, and legal names for what SDF names freely."""

from .arguments import Arguments, parse_arguments
from .make import anonymous_name, ros_name, ros_names
from .resolve import (
    canonical_name,
    is_legal_base_name,
    is_legal_name,
    join_names,
    parent_namespace,
    resolve_name,
)

__all__ = [
    "Arguments",
    "anonymous_name",
    "canonical_name",
    "is_legal_base_name",
    "is_legal_name",
    "join_names",
    "parent_namespace",
    "parse_arguments",
    "resolve_name",
    "ros_name",
    "ros_names",
]
