"""topic_tools/mux: forwards one of several topics, selected by a service."""

from typing import TYPE_CHECKING, Any

from trundle.ros import Node, RawMessage, ServiceError

from ..host import NodeHost
from ..private_parameters import private_parameters
from .raw_relay import RawPublisher, RawSubscriber, subscribe_lazily

if TYPE_CHECKING:
    from trundle.ros.message_types import topic_tools

_NONE = "__none"


class Mux:
    """Subscribes to all inputs, or with ~lazy only to the selected one and while the output has subscribers."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._inputs: dict[str, RawSubscriber] = {}
        """Global name → subscription, in the order given."""
        self._selected: str | None = None

    async def run(self) -> int:
        """Forward until cancelled."""
        node, arguments = self._node, self._arguments
        if len(arguments) < 2:
            node.log.error(f"usage: mux OUT_TOPIC IN_TOPIC1 [IN_TOPIC2 …]; got {' '.join(arguments)!r}")
            return 1
        settings = await private_parameters(node)
        self._output = RawPublisher(node, arguments[0], latch=settings.flag("latch", default=False))
        self._selected_topic = node.advertise("mux/selected", "std_msgs/String", latch=True, queue_size=1)
        for topic in arguments[1:]:
            self._add(topic)
        self._begin(settings.text("initial_topic", ""))
        node.advertise_service("mux/select", "topic_tools/MuxSelect", self._select)
        node.advertise_service(f"{arguments[0]}_select", "topic_tools/MuxSelect", self._select_legacy)
        node.advertise_service("mux/add", "topic_tools/MuxAdd", self._add_service)
        node.advertise_service("mux/delete", "topic_tools/MuxDelete", self._delete)
        node.advertise_service("mux/list", "topic_tools/MuxList", self._list)
        if settings.flag("lazy", default=False):
            await subscribe_lazily(
                node,
                self._output,
                lambda: [(subscriber, name == self._selected) for name, subscriber in self._inputs.items()],
            )
        await node.closed.wait()
        return 0

    def _add(self, topic: str) -> None:
        name = self._node.resolve(topic)

        def on_message(message: RawMessage) -> None:
            if self._selected == name:
                self._output.publish(message)

        self._inputs[name] = RawSubscriber(self._node, name, on_message)
        self._inputs[name].subscribe()

    def _begin(self, topic: str) -> None:
        """Select ~initial_topic, else the first input; if ~initial_topic is unknown, select none."""
        try:
            self._choose(topic or next(iter(self._inputs)))
        except ServiceError as error:
            self._node.log.warn(f"~initial_topic: {error}; nothing is selected")
            self._choose(_NONE)

    def _choose(self, topic: str) -> str:
        """Select a topic; returns the previous one."""
        name = None if topic == _NONE else self._node.resolve(topic)
        if name is not None and name not in self._inputs:
            raise ServiceError(f"no input {name!r}; inputs: {', '.join(self._inputs) or 'none'}")
        previous, self._selected = self._selected, name
        self._selected_topic.publish({"data": topic})
        return previous or ""

    def _select(self, request: "topic_tools.MuxSelectRequest") -> dict[str, Any]:
        return {"prev_topic": self._choose(request.topic)}

    def _select_legacy(self, request: "topic_tools.MuxSelectRequest") -> dict[str, Any]:
        self._node.log.warn("the <topic>_select service is deprecated; use mux/select instead")
        return self._select(request)

    def _add_service(self, request: "topic_tools.MuxAddRequest") -> dict[str, Any]:
        name = self._node.resolve(request.topic)
        if request.topic == _NONE or name in self._inputs:
            raise ServiceError(f"{request.topic!r} is an input already, or not a valid name")
        self._add(name)
        return {}

    def _delete(self, request: "topic_tools.MuxDeleteRequest") -> dict[str, Any]:
        name = self._node.resolve(request.topic)
        if name == self._selected:
            raise ServiceError(f"{name!r} is selected; select another one first")
        source = self._inputs.pop(name, None)
        if source is None:
            raise ServiceError(f"no input {name!r}; inputs: {', '.join(self._inputs) or 'none'}")
        source.unsubscribe()
        return {}

    def _list(self, _request: "topic_tools.MuxListRequest") -> dict[str, Any]:
        return {"topics": list(self._inputs)}
