"""rosapi_node: the services below /rosapi."""

import json
from collections.abc import Awaitable, Callable
from typing import Any
from urllib.parse import urlsplit

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import RosParameters
from trundle.ros import MasterError, Message, MessageError, Node, ParameterError, ServiceError

from ..globs import allows, read_globs
from ..host import NodeHost
from .graph_state import action_servers, read_graph, service_type, service_types, topic_types
from .type_details import type_details

_GLOBS = ("topics_glob", "services_glob", "params_glob")
_Fields = dict[str, Any]
_Handler = Callable[[Message], Awaitable[_Fields]]


class Rosapi:
    """Services on topics, services, nodes, types and parameters.

    Parameters topics_glob, services_glob and params_glob: patterns of the visible names.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        settings = RosParameters(await node.params.get("~", {}), node.name)
        try:
            self._topics_glob, self._services_glob, self._params_glob = (
                read_globs(settings.text(name, ""), f"{node.name}/{name}") for name in _GLOBS
            )
        except UsageError as error:
            node.log.fatal(str(error))
            return 1
        for name, (kind, handler) in self._services().items():
            node.advertise_service(f"/rosapi/{name}", f"rosapi/{kind}", handler)
        await node.wait_registered()
        node.log.info("Rosapi started")
        await node.closed.wait()
        return 0

    def _services(self) -> dict[str, tuple[str, _Handler]]:
        """Return name → type, handler."""
        return {
            "topics": ("Topics", self._get_topics),
            "topics_for_type": ("TopicsForType", self._topics_for_type),
            "topics_and_raw_types": ("TopicsAndRawTypes", self._topics_and_raw_types),
            "topic_type": ("TopicType", self._topic_type),
            "publishers": ("Publishers", self._publishers),
            "subscribers": ("Subscribers", self._subscribers),
            "action_servers": ("GetActionServers", self._action_servers),
            "nodes": ("Nodes", self._nodes),
            "node_details": ("NodeDetails", self._node_details),
            "services": ("Services", self._get_services),
            "services_for_type": ("ServicesForType", self._services_for_type),
            "service_type": ("ServiceType", self._service_type),
            "service_providers": ("ServiceProviders", self._service_providers),
            "service_node": ("ServiceNode", self._service_node),
            "service_host": ("ServiceHost", self._service_host),
            "message_details": ("MessageDetails", self._message_details),
            "service_request_details": ("ServiceRequestDetails", self._request_details),
            "service_response_details": ("ServiceResponseDetails", self._response_details),
            "set_param": ("SetParam", self._set_param),
            "get_param": ("GetParam", self._get_param),
            "has_param": ("HasParam", self._has_param),
            "search_param": ("SearchParam", self._search_param),
            "delete_param": ("DeleteParam", self._delete_param),
            "get_param_names": ("GetParamNames", self._param_names),
            "get_time": ("GetTime", self._time),
        }

    # -- topics

    async def _typed_topics(self) -> dict[str, str]:
        """Return the visible topics with their types, '' if unknown."""
        types = await topic_types(self._node)
        topics = (await read_graph(self._node)).topics
        return {name: types.get(name, "") for name in sorted(topics) if allows(self._topics_glob, name)}

    async def _get_topics(self, _: Message) -> _Fields:
        topics = await self._typed_topics()
        return {"topics": list(topics), "types": list(topics.values())}

    async def _topics_for_type(self, request: Message) -> _Fields:
        topics = await self._typed_topics()
        return {"topics": [name for name, kind in topics.items() if kind == request.type]}

    async def _topics_and_raw_types(self, request: Message) -> _Fields:
        fields = await self._get_topics(request)
        return {**fields, "typedefs_full_text": [self._definition(kind) for kind in fields["types"]]}

    async def _topic_type(self, request: Message) -> _Fields:
        return {"type": (await self._typed_topics()).get(self._node.resolve(request.topic), "")}

    async def _publishers(self, request: Message) -> _Fields:
        state = await read_graph(self._node)
        return {"publishers": self._public(state.publishers.get(request.topic, []), request.topic)}

    async def _subscribers(self, request: Message) -> _Fields:
        state = await read_graph(self._node)
        return {"subscribers": self._public(state.subscribers.get(request.topic, []), request.topic)}

    async def _action_servers(self, _: Message) -> _Fields:
        return {"action_servers": action_servers(set(await self._typed_topics()))}

    # -- nodes and services

    async def _nodes(self, _: Message) -> _Fields:
        return {"nodes": (await read_graph(self._node)).nodes}

    async def _node_details(self, request: Message) -> _Fields:
        state = await read_graph(self._node)
        tables = {"subscribing": state.subscribers, "publishing": state.publishers, "services": state.services}
        return {
            field: sorted(name for name, nodes in table.items() if request.node in nodes)
            for field, table in tables.items()
        }

    async def _public_services(self) -> dict[str, list[str]]:
        services = (await read_graph(self._node)).services
        return {name: services[name] for name in sorted(services) if allows(self._services_glob, name)}

    async def _get_services(self, _: Message) -> _Fields:
        return {"services": list(await self._public_services())}

    async def _services_for_type(self, request: Message) -> _Fields:
        types = await service_types(self._node, list(await self._public_services()))
        return {"services": [name for name, kind in types.items() if kind == request.type]}

    async def _service_type(self, request: Message) -> _Fields:
        is_public = allows(self._services_glob, request.service)
        return {"type": await service_type(self._node, request.service) if is_public else ""}

    async def _service_providers(self, request: Message) -> _Fields:
        services = await self._public_services()
        types = await service_types(self._node, list(services))
        return {
            "providers": [node for name, nodes in services.items() if types[name] == request.service for node in nodes]
        }

    async def _service_node(self, request: Message) -> _Fields:
        nodes = (await read_graph(self._node)).services.get(request.service, [])
        return {"node": nodes[0] if nodes else ""}

    async def _service_host(self, request: Message) -> _Fields:
        try:
            uri = str(await self._node.master.call("lookupService", request.service))
        except MasterError:
            return {"host": ""}
        return {"host": urlsplit(uri).hostname or ""}

    # -- types

    async def _message_details(self, request: Message) -> _Fields:
        return self._details(request.type)

    async def _request_details(self, request: Message) -> _Fields:
        return self._details(self._service_part(request.type, is_request=True))

    async def _response_details(self, request: Message) -> _Fields:
        return self._details(self._service_part(request.type, is_request=False))

    def _service_part(self, type_name: str, *, is_request: bool) -> str:
        try:
            kind = self._node.messages.service(type_name)
        except MessageError as error:
            raise ServiceError(str(error)) from None
        return kind.request if is_request else kind.response

    def _details(self, type_name: str) -> _Fields:
        try:
            return {"typedefs": type_details(self._node.messages, type_name)}
        except MessageError as error:
            raise ServiceError(str(error)) from None

    def _definition(self, type_name: str) -> str:
        try:
            return self._node.messages.definition(type_name) if type_name else ""
        except MessageError:
            return ""

    # -- parameters

    async def _set_param(self, request: Message) -> _Fields:
        if allows(self._params_glob, request.name):
            try:
                await self._node.params.set(request.name, json.loads(request.value))
            except (ValueError, RecursionError):
                raise ServiceError(
                    "Due to the type flexibility of the ROS parameter server, "
                    "the value argument to set_param must be a JSON-formatted string."
                ) from None
            except ParameterError as error:
                raise ServiceError(str(error)) from None
        return {}

    async def _get_param(self, request: Message) -> _Fields:
        if not allows(self._params_glob, request.name):
            return {}
        default: object = None
        if request.default:
            try:
                default = json.loads(request.default)
            except (ValueError, RecursionError):
                default = str(request.default)
        return {"value": json.dumps(await self._node.params.get(request.name, default), default=str)}

    async def _has_param(self, request: Message) -> _Fields:
        is_public = allows(self._params_glob, request.name)
        return {"exists": is_public and await self._node.params.has(request.name)}

    async def _search_param(self, request: Message) -> _Fields:
        is_public = allows(self._params_glob, request.name)
        name = await self._node.params.search(request.name) if is_public and request.name else None
        return {"global_name": name or ""}

    async def _delete_param(self, request: Message) -> _Fields:
        if allows(self._params_glob, request.name) and await self._node.params.has(request.name):
            await self._node.params.delete(request.name)
        return {}

    async def _param_names(self, _: Message) -> _Fields:
        names = await self._node.master.call("getParamNames")
        return {"names": [name for name in names if allows(self._params_glob, name)]}

    async def _time(self, _: Message) -> _Fields:
        return {"time": self._node.clock.now_ns()}

    def _public(self, nodes: list[str], topic: str) -> list[str]:
        return nodes if allows(self._topics_glob, topic) else []
