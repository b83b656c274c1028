"""Addresses, by the name that older programs import."""

from rosgraph.network import (
    ROS_HOSTNAME as ROS_HOSTNAME,
)
from rosgraph.network import (
    ROS_IP as ROS_IP,
)
from rosgraph.network import (
    ROSHandshakeException as ROSHandshakeException,
)
from rosgraph.network import (
    create_local_xmlrpc_uri as create_local_xmlrpc_uri,
)
from rosgraph.network import (
    decode_ros_handshake_header as decode_ros_handshake_header,
)
from rosgraph.network import (
    encode_ros_handshake_header as encode_ros_handshake_header,
)
from rosgraph.network import (
    get_address_override as get_address_override,
)
from rosgraph.network import (
    get_bind_address as get_bind_address,
)
from rosgraph.network import (
    get_host_name as get_host_name,
)
from rosgraph.network import (
    get_local_address as get_local_address,
)
from rosgraph.network import (
    get_local_addresses as get_local_addresses,
)
from rosgraph.network import (
    is_local_address as is_local_address,
)
from rosgraph.network import (
    parse_http_host_and_port as parse_http_host_and_port,
)
from rosgraph.network import (
    read_ros_handshake_header as read_ros_handshake_header,
)
from rosgraph.network import (
    write_ros_handshake_header as write_ros_handshake_header,
)
