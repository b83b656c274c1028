"""The ROS master with its parameter server: every call of rosmaster, with its codes and texts.

Calls never block; updates to nodes are queued per node, so that a dead node delays no other.
"""

import os
from collections.abc import Callable
from typing import Any

from trundle.robots.names import canonical_name, parent_namespace, resolve_name

from ..errors import ParameterError
from ..transport.network import LOOPBACK, server_address
from ..xmlrpc.rpc_methods import Answer, BadArgumentError, Method, answer_call, name_argument
from ..xmlrpc.rpc_server import RpcServer
from ..xmlrpc.xmlrpc_text import encode_response
from .parameters import MAX_BYTES, ParameterTree, encoded_bytes, updates
from .registry import RegistrationTable, Registry
from .slave_calls import Pending, SlaveCalls

ANY_TYPE = "*"


class Master:
    """Registry, parameter server and XML-RPC interface of one ROS graph."""

    def __init__(self, pending: Pending, *, on_shutdown: Callable[[str], None] | None = None) -> None:
        """Create a master; `start` listens.

        Args:
            pending: tracks updates to nodes as work in progress.
            on_shutdown: called with the reason when a client asks the master to stop.
        """
        self.parameters = ParameterTree()
        self.uri = ""
        self.on_call: Callable[[str, list[Any], Answer], None] = lambda _method, _arguments, _answer: None
        """Called with each call and its answer."""
        self._on_shutdown = on_shutdown
        self._registry = Registry()
        self._types: dict[str, str] = {}
        self._slave_calls = SlaveCalls(pending)
        self._server = RpcServer(self.dispatch)
        self._methods: dict[str, Method] = {
            "getPid": (0, -1, self._get_pid),
            "getUri": (0, "", self._get_uri),
            "shutdown": (1, 0, self._shutdown),
            "lookupNode": (1, "", self._lookup_node),
            "lookupService": (1, "", self._lookup_service),
            "getSystemState": (0, [[], [], []], self._system_state),
            "getTopicTypes": (0, [], self._topic_types),
            "getPublishedTopics": (1, 0, self._published_topics),
            "registerPublisher": (3, [], self._register_publisher),
            "unregisterPublisher": (2, 0, self._unregister_publisher),
            "registerSubscriber": (3, [], self._register_subscriber),
            "unregisterSubscriber": (2, 0, self._unregister_subscriber),
            "registerService": (3, 0, self._register_service),
            "unregisterService": (2, 0, self._unregister_service),
            "setParam": (2, 0, self._set_param),
            "getParam": (1, 0, self._get_param),
            "hasParam": (1, False, self._has_param),
            "deleteParam": (1, 0, self._delete_param),
            "searchParam": (1, 0, self._search_param),
            "getParamNames": (0, [], self._param_names),
            "subscribeParam": (2, 0, self._subscribe_param),
            "unsubscribeParam": (2, 0, self._unsubscribe_param),
        }

    async def start(self, port: int, host: str | None = None) -> None:
        """Listen; port 0: any free port.

        Raises:
            PortTakenError: another program listens there.
        """
        address = server_address(host)
        await self._server.start(address.bind or LOOPBACK, port)
        self.uri = f"http://{address.authority(self._server.port)}/"

    @property
    def port(self) -> int:
        """Port of the XML-RPC server."""
        return self._server.port

    async def stop(self) -> None:
        """Stop listening; nodes are not notified, since they run on without a master."""
        await self._server.stop()
        await self._slave_calls.stop()

    def dispatch(self, method: str, arguments: list[Any]) -> Answer | list[Any]:
        """Execute one call."""
        if method == "system.multicall":
            return self._multicall(arguments[0])
        if method == "system.listMethods":
            return sorted([*self._methods, "system.multicall"])
        answer = answer_call(self._methods, method, arguments)
        self.on_call(method, arguments, answer)
        return answer

    def _multicall(self, calls: list[dict[str, Any]]) -> list[Any]:
        """Execute several calls.

        Raises:
            ParameterError: the answers together exceed the size limit of one.
        """
        answers: list[Any] = []
        size = 0
        for call in calls:
            answer = self.dispatch(str(call["methodName"]), list(call["params"]))
            size += encoded_bytes(answer)
            if size > MAX_BYTES:
                raise ParameterError(f"the answers take more than {MAX_BYTES} bytes; make fewer calls at once")
            answers.append([answer])
        return answers

    def _get_pid(self, _: str) -> Answer:
        return 1, "", os.getpid()

    def _get_uri(self, _: str) -> Answer:
        return 1, "", self.uri

    def _shutdown(self, caller: str, reason: Any) -> Answer:
        if self._on_shutdown is not None:
            self._on_shutdown(f"external shutdown request from [{caller}]: {reason}")
        return 1, "shutdown", 0

    # -- lookups

    def _lookup_node(self, caller: str, node: Any) -> Answer:
        name = "/" if node == "/" else name_argument("node", node, caller)
        api = self._registry.nodes.get(name)
        return (1, "node api", api) if api else (-1, f"unknown node [{name}]", "")

    def _lookup_service(self, caller: str, service: Any) -> Answer:
        _, api = self._registry.service_apis.get(name_argument("service", service, caller), ("", ""))
        return (1, f"rosrpc URI: [{api}]", api) if api else (-1, "no provider", "")

    def _topic_types(self, _: str) -> Answer:
        return 1, "current system state", [list(item) for item in self._types.items()]

    def _system_state(self, _: str) -> Answer:
        registry = self._registry
        return (
            1,
            "current system state",
            [t.state() for t in (registry.publishers, registry.subscribers, registry.services)],
        )

    def _published_topics(self, caller: str, subgraph: Any) -> Answer:
        if not isinstance(subgraph, str):
            raise BadArgumentError("ERROR: parameter [subgraph] must be a string")
        prefix = resolve_name(subgraph, caller) if subgraph else ""
        if prefix and not prefix.endswith("/"):
            prefix += "/"
        names = [name for name in self._registry.publishers.entries if name.startswith(prefix)]
        return 1, "current topics", [[name, self._types.get(name, ANY_TYPE)] for name in names]

    # -- topics and services

    def _register_publisher(self, caller: str, topic: Any, type_name: Any, api: Any) -> Answer:
        name, kind, uri = name_argument("topic", topic, caller), _type("topic_type", type_name), _api("caller_api", api)
        self._register(self._registry.publishers, name, caller, uri)
        if kind != ANY_TYPE or name not in self._types:
            self._types[name] = kind
        self._notify_subscribers(name)
        return 1, f"Registered [{caller}] as publisher of [{name}]", self._registry.subscribers.apis(name)

    def _unregister_publisher(self, caller: str, topic: Any, api: Any) -> Answer:
        name, uri = name_argument("topic", topic, caller), _api("caller_api", api)
        answer = self._registry.unregister(self._registry.publishers, name, caller, uri)
        if answer[2]:
            self._notify_subscribers(name)
        return answer

    def _register_subscriber(self, caller: str, topic: Any, type_name: Any, api: Any) -> Answer:
        name, kind, uri = name_argument("topic", topic, caller), _type("topic_type", type_name), _api("caller_api", api)
        self._register(self._registry.subscribers, name, caller, uri)
        if kind != ANY_TYPE:
            self._types.setdefault(name, kind)
        return 1, f"Subscribed to [{name}]", self._registry.publishers.apis(name)

    def _unregister_subscriber(self, caller: str, topic: Any, api: Any) -> Answer:
        name, uri = name_argument("topic", topic, caller), _api("caller_api", api)
        return self._registry.unregister(self._registry.subscribers, name, caller, uri)

    def _register_service(self, caller: str, service: Any, service_api: Any, api: Any) -> Answer:
        name, rpc, uri = (
            name_argument("service", service, caller),
            _api("service_api", service_api),
            _api("caller_api", api),
        )
        self._replace(caller, self._registry.register_service(name, caller, uri, rpc))
        return 1, f"Registered [{caller}] as provider of [{name}]", 1

    def _unregister_service(self, caller: str, service: Any, service_api: Any) -> Answer:
        name, rpc = name_argument("service", service, caller), _api("service_api", service_api)
        return self._registry.unregister_service(name, caller, rpc)

    def _register(self, table: RegistrationTable, name: str, caller: str, uri: str) -> None:
        self._replace(caller, self._registry.register(table, name, caller, uri))

    def _replace(self, node: str, older_uri: str | None) -> None:
        if older_uri is not None:
            reason = f"[{node}] Reason: new node registered with same name"
            self._slave_calls.send(older_uri, "shutdown", "/master", reason)

    def _notify_subscribers(self, topic: str) -> None:
        publishers = self._registry.publishers.apis(topic)
        for uri in self._registry.subscribers.apis(topic):
            self._slave_calls.send(uri, "publisherUpdate", "/master", topic, publishers)

    # -- parameters

    def _set_param(self, caller: str, key: Any, value: Any) -> Answer:
        name = _parameter(key, caller)
        if value is None:
            raise BadArgumentError("ERROR: parameter [value] must be specified")
        try:
            encode_response(value)  # otherwise getParam of the namespace would fail: XML-RPC cannot encode the value
            self.set_param(name, value, by=caller)
        except ValueError as error:
            return -1, f"ERROR: parameter [value]: {error}", 0
        except TypeError as error:
            return -1, f"Error: invalid arguments: {error}", 0
        except ParameterError as error:
            return -1, f"ERROR: {error}", 0
        return 1, f"parameter {name} set", 0

    def set_param(self, name: str, value: object, by: str = "/master") -> None:
        """Set a parameter by its global name and notify its subscribers, except the node that set it.

        Raises:
            ParameterError: the tree would exceed its size or depth.
            TypeError: the root must be a dictionary.
        """
        self.parameters.set(name, value)
        self._notify_param_subscribers(name, value, by)

    def _delete_param(self, caller: str, key: Any) -> Answer:
        name = _parameter(key, caller)
        try:
            self.parameters.delete(name)
        except KeyError:
            return -1, f"parameter [{name}] is not set", 0
        self._notify_param_subscribers(name, {}, None)
        return 1, f"parameter {name} deleted", 0

    def _get_param(self, caller: str, key: Any) -> Answer:
        name = _parameter(key, caller)
        try:
            return 1, f"Parameter [{name}]", self.parameters.get(name)
        except KeyError:
            return -1, f"Parameter [{name}] is not set", 0

    def _has_param(self, caller: str, key: Any) -> Answer:
        name = _parameter(key, caller)
        return 1, name, self.parameters.has(name)

    def _search_param(self, caller: str, key: Any) -> Answer:
        key = _key(key)
        if key.startswith("~"):
            return 0, "Internal failure: invalid key", 0
        if not caller.startswith("/"):
            return 0, "Internal failure: namespace must be global", 0
        name = self.parameters.search(caller, key)
        if name is None:
            return -1, f"Cannot find parameter [{key}] in an upwards search", ""
        return 1, f"Found [{name}]", name

    def _subscribe_param(self, caller: str, api: Any, key: Any) -> Answer:
        name, uri = _parameter(key, caller), _api("caller_api", api)
        self._register(self._registry.parameters, _subscription_key(name), caller, uri)
        value = self.parameters.get(name) if self.parameters.has(name) else {}
        return 1, f"Subscribed to parameter [{name}]", value

    def _unsubscribe_param(self, caller: str, api: Any, key: Any) -> Answer:
        name, uri = _parameter(key, caller), _api("caller_api", api)
        self._registry.unregister(self._registry.parameters, _subscription_key(name), caller, uri)
        return 1, f"Unsubscribe to parameter [{name}]", 1

    def _param_names(self, _: str) -> Answer:
        return 1, "Parameter names", self.parameters.names()

    def _notify_param_subscribers(self, name: str, value: object, by: str | None) -> None:
        table = self._registry.parameters.entries
        for key, changed, new in updates(list(table), name, value):
            # The node that set a namespace may subscribe to keys in it.
            is_set_key = changed == _subscription_key(name)
            for node, uri in table[key]:
                if node != by or not is_set_key:
                    self._slave_calls.send(uri, "paramUpdate", "/master", changed, new)


def _subscription_key(name: str) -> str:
    return "/" if name == "/" else canonical_name(name) + "/"


def _key(value: Any) -> str:
    if not value:
        raise BadArgumentError("ERROR: parameter [key] must be specified and non-empty")
    if not isinstance(value, str):
        raise BadArgumentError("ERROR: parameter [key] must be a string")
    return value


def _parameter(value: Any, caller: str) -> str:
    return resolve_name(_key(value), caller) or parent_namespace(caller)


def _type(argument: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{argument}] must be a non-empty string")
    if value != ANY_TYPE and value.count("/") != 1:
        raise BadArgumentError(f"ERROR: parameter [{argument}] is not a valid package resource name")
    return value


def _api(argument: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{argument}] is not an XMLRPC URI")
    if not value.startswith(("http://", "rosrpc://")):
        raise BadArgumentError(f"ERROR: parameter [{argument}] is not an RPC URI")
    return value
