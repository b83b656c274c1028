from .arguments import Arguments as Arguments, parse_arguments as parse_arguments
from .make import anonymous_name as anonymous_name, ros_name as ros_name, ros_names as ros_names
from .resolve import (
    canonical_name as canonical_name,
    is_legal_base_name as is_legal_base_name,
    is_legal_name as is_legal_name,
    join_names as join_names,
    parent_namespace as parent_namespace,
    resolve_name as resolve_name,
)
