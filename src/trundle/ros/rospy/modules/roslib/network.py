"""Addresses, under the name that older programs import."""

from rosgraph.network import (
    ROS_HOSTNAME as ROS_HOSTNAME,
    ROS_IP as ROS_IP,
    ROSHandshakeException as ROSHandshakeException,
    create_local_xmlrpc_uri as create_local_xmlrpc_uri,
    decode_ros_handshake_header as decode_ros_handshake_header,
    encode_ros_handshake_header as encode_ros_handshake_header,
    get_address_override as get_address_override,
    get_bind_address as get_bind_address,
    get_host_name as get_host_name,
    get_local_address as get_local_address,
    get_local_addresses as get_local_addresses,
    is_local_address as is_local_address,
    parse_http_host_and_port as parse_http_host_and_port,
    read_ros_handshake_header as read_ros_handshake_header,
    write_ros_handshake_header as write_ros_handshake_header,
)
