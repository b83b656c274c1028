"""Services: provider and client."""

import sys
import traceback
import warnings
from collections.abc import Callable
from typing import Any

import genpy
import rosgraph.names
from trundle.ros.errors import ServiceError
from trundle.ros.messages.raw_message import ServiceType
from trundle.ros.node.graph_node import Node
from trundle.ros.node.service import Service as GraphService
from trundle.ros.transport.tcpros import FrameProtocol

from . import core, graph
from .exceptions import ROSInterruptException, TransportException, TransportInitError
from .msg import args_kwds_to_message, framed
from .names import resolve_name
from .service_connection import ServiceConnection
from .service_wait import wait_for_service

DEFAULT_BUFF_SIZE = 65536
_services: dict[str, "ServiceImpl"] = {}


class ServiceException(Exception):
    """A service failed or is unavailable."""


def convert_return_to_response(response: Any, response_class: Any) -> Any:
    """Response of a handler's result: the response itself, its fields by name or in order, or its only field.

    Raises:
        ServiceException: the result is None, or does not fit.
    """
    if getattr(response, "_type", None) == response_class._type:
        return response
    if type(response) is dict:
        try:
            return response_class(**response)
        except AttributeError as error:
            raise ServiceException(f"handler returned invalid value: {error}") from None
    if response is None:
        raise ServiceException("service handler returned None")
    is_several = type(response) in (list, tuple)
    try:
        return response_class(*(response if is_several else (response,)))
    except TypeError as error:
        fault = "wrong number of values" if is_several else "invalid value"
        raise ServiceException(f"handler returned {fault}: {error}") from None


class _Service:
    def __init__(self, name: str, service_class: Any) -> None:
        self.resolved_name = resolve_name(name)
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class
        self.uri: str | None = None


class ServiceImpl(_Service):
    """A service that this node provides."""

    def __init__(
        self,
        name: Any,
        service_class: Any,
        handler: Callable[[Any], Any],
        buff_size: int = DEFAULT_BUFF_SIZE,
        error_handler: Callable[..., object] | None = None,
    ) -> None:
        if not name or not isinstance(name, str):
            raise ValueError("service name is not a non-empty string")
        if not rosgraph.names.is_legal_name(name):
            text = f"'{name}' is not a legal ROS graph resource name. This may cause problems with other ROS tools"
            warnings.warn(text, stacklevel=3)
        super().__init__(name, service_class)
        self.handler = handler
        self.buff_size = buff_size
        self.done = False
        self.seq = 0
        self._error_handler = error_handler or self.error_handler
        self._provider: GraphService | None = None

    def error_handler(self, e: Exception, exc_type: Any, exc_value: Any, tb: Any) -> None:
        """Log a handler's exception."""
        core.logerr(f"Error processing request: {e}\n{traceback.format_exception(exc_type, exc_value, tb)}")

    def start(self, node: Node) -> None:
        """Advertise."""
        cls = self.service_class
        graph.byte_messages().services[cls._type] = ServiceType(
            type=cls._type,
            md5sum=cls._md5sum,
            request=cls._request_class._type,
            response=cls._response_class._type,
        )
        self._provider = _Provider(
            node, self.resolved_name, cls._type, self._answer, unregister=node.endpoints.remove_service
        )
        node.endpoints.add_service(self._provider)

    def register(self) -> None:
        """Advertise; returns once the service is registered.

        Raises:
            ServiceException: this node provides a service of this name already.
        """
        if self.resolved_name in _services:
            raise ServiceException(f"service [{self.resolved_name}] already registered")
        _services[self.resolved_name] = self
        graph.when_started(self.start)
        self.uri = None if graph.node is None else graph.node.service_uri

    def shutdown(self, reason: str = "") -> None:
        """Stop providing the service."""
        del reason
        self.done = True
        graph.forget_starter(self.start)
        if _services.get(self.resolved_name) is self:
            del _services[self.resolved_name]
        if self._provider is not None:
            self._provider.unregister()
            if not core.is_shutdown():
                graph.wait_registered()

    def spin(self) -> None:
        """Wait until the service or the node is shut down."""
        from .rostime import wallsleep

        try:
            while not core.is_shutdown() and not self.done:
                wallsleep(0.1)
        except KeyboardInterrupt:
            core.logdebug("keyboard interrupt, shutting down")

    def _answer(self, data: bytes) -> bytes:
        """Serialized response to a serialized request."""
        try:
            request = self.request_class().deserialize(data)
            request._connection_header = getattr(data, "header", {})
            response = convert_return_to_response(self.handler(request), self.response_class)
            self.seq += 1
            pieces = framed(self.seq, response)
        except ServiceException as error:
            core.rospydebug("handler raised ServiceException: %s", error)
            raise ServiceError(str(error)) from None
        except Exception as error:
            self._error_handler(error, *sys.exc_info())
            raise _HandlerError(str(error)) from None
        return b"".join(pieces)[4:]


class _RequestBytes(bytes):
    """A serialized request with the header of its connection."""

    header: dict[str, str]


class _Provider(GraphService):
    """Service whose requests carry the header of their connection."""

    def request(self, link: FrameProtocol, data: bytes | memoryview) -> None:
        request = _RequestBytes(data)
        request.header = link.header or {}
        super().request(link, request)


class _HandlerError(Exception):
    """Exception of a handler; its text goes to the client."""


class Service(ServiceImpl):
    """A service that this node provides; each request is handled in a thread of its own."""

    def __init__(
        self,
        name: str,
        service_class: Any,
        handler: Callable[[Any], Any],
        buff_size: int = DEFAULT_BUFF_SIZE,
        error_handler: Callable[..., object] | None = None,
    ) -> None:
        """Advertise a service.

        Args:
            name: resolved and remapped.
            service_class: class of the service.
            handler: takes the request, and returns the response, its fields, or its only field.
            buff_size: no effect; requests of any size are received.
            error_handler: takes an exception of the handler, its type, itself and its traceback.

        Raises:
            ServiceException: this node provides a service of this name already.
        """
        super().__init__(name, service_class, handler, buff_size, error_handler)
        self.register()


class ServiceProxy(_Service):
    """Client of a service: call it with the request or its fields."""

    def __init__(
        self, name: str, service_class: Any, persistent: bool = False, headers: dict[str, str] | None = None
    ) -> None:
        """Create a client; connects when called.

        Args:
            name: resolved and remapped.
            service_class: class of the service.
            persistent: keep the connection.
            headers: further fields of the connection header.
        """
        super().__init__(name, service_class)
        self.persistent = persistent
        self.buff_size = DEFAULT_BUFF_SIZE
        self.seq = 0
        self.transport: ServiceConnection | None = None
        self._headers = {**(headers or {}), **({"persistent": "1"} if persistent else {})}

    def wait_for_service(self, timeout: Any = None) -> None:
        """Wait until the service is available; see `rospy.wait_for_service`."""
        wait_for_service(self.resolved_name, timeout=timeout)

    def __call__(self, *args: Any, **kwds: Any) -> Any:
        """Call the service; see `call`."""
        return self.call(*args, **kwds)

    def call(self, *args: Any, **kwds: Any) -> Any:
        """Call the service with a request, or its fields in order or by name.

        Raises:
            ServiceException: the service is unavailable or failed.
            genpy.SerializationError: a field's value does not fit.
            ROSInterruptException: shutdown.
            TypeError: a request of another type.
        """
        request = args_kwds_to_message(self.request_class, args, kwds)
        connection = self.transport or self._connect(request)
        self.seq += 1
        try:
            pieces = framed(self.seq, request)
        except genpy.SerializationError:
            self._release(connection)
            raise
        try:
            is_good, data = connection.exchange(pieces)
        except TransportException as error:
            self.transport = None
            connection.close()
            if core.is_shutdown():
                raise ROSInterruptException("node shutdown interrupted service call") from None
            raise ServiceException(f"transport error completing service call: {error}") from None
        self._release(connection)
        if not is_good:
            text = data.decode(errors="replace")
            raise ServiceException(f"service [{self.resolved_name}] responded with an error: {text.encode()}")
        response = self.response_class().deserialize(data)
        response._connection_header = connection.header
        return response

    def close(self) -> None:
        """Close a persistent connection."""
        if self.transport is not None:
            self.transport.close()
            self.transport = None

    def _connect(self, request: Any) -> ServiceConnection:
        if not isinstance(request, genpy.Message):
            raise TypeError("request object is not a valid request message instance")
        if self.request_class._type != request._type:
            raise TypeError(f"request object type [{type(request)}] does not match service type [{self.request_class}]")
        try:
            self.uri = rosgraph.Master(core.get_caller_id()).lookupService(self.resolved_name)
        except OSError:
            raise ServiceException("unable to contact master") from None
        except rosgraph.MasterException:
            raise ServiceException(f"service [{self.resolved_name}] unavailable") from None
        cls = self.service_class
        header = {"service": self.resolved_name, "md5sum": cls._md5sum, "callerid": core.get_caller_id()}
        try:
            connection = ServiceConnection(core.parse_rosrpc_uri(str(self.uri)), {**header, **self._headers})
        except core.ParameterInvalid:
            raise ServiceException(f"master returned invalid ROSRPC URI: {self.uri}") from None
        except TransportInitError as error:
            raise ServiceException(f"unable to connect to service: {error}") from None
        if self.persistent:
            self.transport = connection
        return connection

    def _release(self, connection: ServiceConnection) -> None:
        if not self.persistent:
            connection.close()
