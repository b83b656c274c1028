"""Names of resources in packages."""

from roslib.names import (
    is_legal_resource_base_name as is_legal_resource_base_name,
    is_legal_resource_name as is_legal_resource_name,
    package_resource_name as package_resource_name,
    resource_name as resource_name,
    resource_name_base as resource_name_base,
    resource_name_package as resource_name_package,
)
