"""Services of the graph: types, classes, calls."""

import socket
import sys
from io import BytesIO
from typing import Any

import genpy
import rosgraph
import rosgraph.network
from genpy.message import fill_message_args, get_printable_message_args, get_service_class

NAME = "rosservice"


class ROSServiceException(Exception):
    """Base class."""


class ROSServiceIOException(ROSServiceException):
    """The master or a service does not respond."""


def get_service_headers(service_name: str, service_uri: str) -> dict[str, str]:
    """Connection header of a service.

    Raises:
        ROSServiceException: the URI is invalid.
        ROSServiceIOException: the service does not answer.
    """
    from rospy.core import ParameterInvalid, parse_rosrpc_uri

    try:
        address = parse_rosrpc_uri(service_uri)
    except ParameterInvalid:
        raise ROSServiceException(f"service [{service_name}] has an invalid RPC URI [{service_uri}]") from None
    header = {"probe": "1", "md5sum": "*", "callerid": f"/{NAME}", "service": service_name}
    try:
        with socket.create_connection(address, timeout=5.0) as connection:
            rosgraph.network.write_ros_handshake_header(connection, header)
            return rosgraph.network.read_ros_handshake_header(connection, BytesIO(), 2048)
    except OSError:
        raise ROSServiceIOException(
            f"Unable to communicate with service [{service_name}], address [{service_uri}]"
        ) from None


def get_service_uri(service_name: str) -> str | None:
    """URI of a service; None for an unknown service.

    Raises:
        ROSServiceIOException: the master does not answer.
    """
    try:
        return rosgraph.Master(f"/{NAME}").lookupService(service_name)
    except rosgraph.MasterException:
        return None
    except OSError:
        raise ROSServiceIOException("Unable to communicate with master!") from None


def get_service_type(service_name: str) -> str | None:
    """Type of a service; None for an unknown service."""
    uri = get_service_uri(service_name)
    return None if uri is None else get_service_headers(service_name, uri).get("type")


def get_service_node(service_name: str) -> str | None:
    """Node that provides a service; None for an unknown service."""
    return next((nodes[0] for name, nodes in get_service_list(include_nodes=True) if name == service_name), None)


def get_service_list(node: str | None = None, namespace: str | None = None, include_nodes: bool = False) -> list[Any]:
    """Names of all services, or of those of a node or in a namespace; pairs (name, nodes) with `include_nodes`."""
    try:
        services = rosgraph.Master(f"/{NAME}").getSystemState()[2]
    except OSError:
        raise ROSServiceIOException("Unable to communicate with master!") from None
    if namespace:
        prefix = rosgraph.names.make_global_ns(namespace)
        services = [entry for entry in services if entry[0] == namespace or entry[0].startswith(prefix)]
    if node is not None:
        services = [entry for entry in services if node in entry[1]]
    return services if include_nodes else [name for name, _ in services]


def rosservice_find(service_type: str) -> list[str]:
    """Names of the services of a type."""
    return [name for name in get_service_list() if get_service_type(name) == service_type]


def get_service_class_by_name(service_name: str) -> Any:
    """Class of a service.

    Raises:
        ROSServiceException: the service or its class is unknown.
    """
    type_name = get_service_type(service_name)
    if not type_name:
        raise ROSServiceException(f"Service [{service_name}] is not available.")
    service_class = get_service_class(type_name)
    if service_class is None:
        raise ROSServiceException(f"Unable to load type [{type_name}].")
    return service_class


def get_service_args(service_name: str) -> str:
    """Names of a service's arguments."""
    return get_printable_message_args(get_service_class_by_name(service_name)._request_class())


def has_service_args(service_name: str, service_class: Any = None) -> bool:
    """True if a service takes arguments."""
    service_class = service_class or get_service_class_by_name(service_name)
    return bool(service_class._request_class.__slots__)


def call_service(service_name: str, service_args: list[Any], service_class: Any = None) -> tuple[Any, Any]:
    """Call a service with YAML values; returns request and response.

    Raises:
        ROSServiceException: the values do not fit, or the service fails.
    """
    import rospy

    service_class = service_class or get_service_class_by_name(service_name)
    request = service_class._request_class()
    try:
        now = rospy.get_rostime() if rospy.core.is_initialized() else genpy.Time()
        fill_message_args(request, service_args, {"now": now, "auto": rospy.Header(stamp=now)})
    except genpy.MessageException as error:
        names = get_printable_message_args(request)
        text = f"Incompatible arguments to call service:\n{error}\nProvided arguments are:\n * {service_args}"
        raise ROSServiceException(f"{text}\n\nService arguments are: [{names}]") from None
    try:
        return request, rospy.ServiceProxy(service_name, service_class)(request)
    except rospy.ServiceException as error:
        raise ROSServiceException(str(error)) from None


def rosservicemain(argv: list[str] | None = None) -> None:
    """Run the command rosservice with its arguments; default: this process's arguments.

    Raises:
        SystemExit: it failed.
    """
    from trundle.app.cli.main import main

    if (code := main(["service", *(sys.argv if argv is None else argv)[1:]])) != 0:
        sys.exit(code)
