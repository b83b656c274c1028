"""topic_tools/mux: one of several topics passed on, chosen by a service."""

from typing import Any

from trundle.ros import Message, Node, RawMessage, ServiceError, Settings

from ..host import Host
from .passing import Inlet, Outlet

_NONE = "__none"


class Mux:
    """Listens to all its inputs, or with ~lazy to the selected one alone."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del host
        self._node = node
        self._arguments = arguments
        self._inlets: dict[str, Inlet] = {}
        """Global name → its subscription, in the order given."""
        self._selected = _NONE
        self._lazy = False

    async def run(self) -> int:
        """Pass on until cancelled."""
        node, words = self._node, self._arguments
        if len(words) < 2:
            node.log_error(f"usage: mux OUT_TOPIC IN_TOPIC1 [IN_TOPIC2 …]; got {' '.join(words)!r}")
            return 1
        settings = Settings(await node.get_param("~", {}), node.name)
        self._lazy = settings.flag("lazy", default=False)
        self._outlet = Outlet(node, words[0])
        self._said = node.advertise("mux/selected", "std_msgs/String", latch=True, queue_size=1)
        for topic in words[1:]:
            self._add(topic)
        self._choose(settings.text("initial_topic", "") or words[1])
        node.advertise_service("mux/select", "topic_tools/MuxSelect", self._select)
        node.advertise_service("mux/add", "topic_tools/MuxAdd", self._asked_to_add)
        node.advertise_service("mux/delete", "topic_tools/MuxDelete", self._delete)
        node.advertise_service("mux/list", "topic_tools/MuxList", self._list)
        await node.closed.wait()
        return 0

    def _add(self, topic: str) -> None:
        name = self._node.resolve(topic)

        def take(message: RawMessage) -> None:
            if self._selected == name:
                self._outlet.put(message)

        self._inlets[name] = Inlet(self._node, name, take)
        if not self._lazy:
            self._inlets[name].open()

    def _choose(self, topic: str) -> str:
        """Select a topic; return what was selected before."""
        name = _NONE if topic == _NONE else self._node.resolve(topic)
        if name != _NONE and name not in self._inlets:
            raise ServiceError(f"no input {name!r}; inputs: {', '.join(self._inlets) or 'none'}")
        before, self._selected = self._selected, name
        if self._lazy:
            for other, inlet in self._inlets.items():
                if other == name:
                    inlet.open()
                else:
                    inlet.close()
        self._said.publish({"data": name})
        return before

    def _select(self, request: Message) -> dict[str, Any]:
        return {"prev_topic": self._choose(request.topic)}

    def _asked_to_add(self, request: Message) -> dict[str, Any]:
        name = self._node.resolve(request.topic)
        if request.topic == _NONE or name in self._inlets:
            raise ServiceError(f"{request.topic!r} is an input already, or no name for one")
        self._add(name)
        return {}

    def _delete(self, request: Message) -> dict[str, Any]:
        name = self._node.resolve(request.topic)
        if name == self._selected:
            raise ServiceError(f"{name!r} is selected; select another one first")
        inlet = self._inlets.pop(name, None)
        if inlet is None:
            raise ServiceError(f"no input {name!r}; inputs: {', '.join(self._inlets) or 'none'}")
        inlet.close()
        return {}

    def _list(self, _request: Message) -> dict[str, Any]:
        return {"topics": list(self._inlets)}
