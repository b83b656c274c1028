"""Names of resources in packages."""

from roslib.names import is_legal_resource_base_name as is_legal_resource_base_name
from roslib.names import is_legal_resource_name as is_legal_resource_name
from roslib.names import package_resource_name as package_resource_name
from roslib.names import resource_name as resource_name
from roslib.names import resource_name_base as resource_name_base
from roslib.names import resource_name_package as resource_name_package
