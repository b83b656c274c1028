"""Talkers and listeners of rospy_tutorials and roscpp_tutorials, on the topic `chatter`."""

from typing import Any

from trundle.ros import Node
from trundle.spatial import NS_PER_S

from ..host import NodeHost
from ..rate import Rate

_TOPIC, _TYPE = "chatter", "std_msgs/String"
_RATE_HZ = 10.0


class Talker:
    """rospy_tutorials/talker: `hello world` and the time, ten times a second."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._count = 0

    async def run(self) -> int:
        """Talk until cancelled."""
        publisher, rate = self._node.advertise(_TOPIC, _TYPE, queue_size=10), Rate(self._node, _RATE_HZ)
        while not self._node.closed.is_set():
            text = self._text()
            self._node.log.info(text)
            publisher.publish({"data": text})
            self._count += 1
            await rate.sleep()
        return 0

    def _text(self) -> str:
        return f"hello world {self._node.clock.now_ns() / NS_PER_S}"


class CppTalker(Talker):
    """roscpp_tutorials/talker: `hello world` and a number, ten times a second."""

    def _text(self) -> str:
        return f"hello world {self._count}"


class Listener:
    """rospy_tutorials/listener: logs each message of `chatter` with the node's name."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Listen until cancelled."""
        self._node.subscribe(_TOPIC, _TYPE, self._on_message, queue_size=1000)
        await self._node.closed.wait()
        return 0

    def _on_message(self, message: Any) -> None:
        self._node.log.info(f"{self._node.name}I heard {message.data}")


class CppListener(Listener):
    """roscpp_tutorials/listener: logs each message of `chatter`."""

    def _on_message(self, message: Any) -> None:
        self._node.log.info(f"I heard: [{message.data}]")
