"""topic_tools/drop: drops X of every Y messages."""

from trundle.ros import Node, RawMessage

from ..host import NodeHost
from .raw_relay import RawPublisher, RawSubscriber

_USAGE = "usage: drop IN_TOPIC X Y [OUT_TOPIC]; X of every Y messages are dropped"


class Drop:
    """Drops the first X of every Y messages."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Drop until cancelled."""
        node, arguments = self._node, self._arguments
        counts = [int(word) for word in arguments[1:3] if word.isdecimal()]
        if not 3 <= len(arguments) <= 4 or len(counts) != 2 or counts[1] < 1:
            node.log.error(f"{_USAGE}; got {' '.join(arguments)!r}")
            return 1
        output = RawPublisher(node, arguments[3] if len(arguments) > 3 else f"{arguments[0]}_drop")
        dropped, period = counts
        count = 0

        def on_message(message: RawMessage) -> None:
            nonlocal count
            if count >= dropped:
                output.publish(message)
            count = (count + 1) % period

        RawSubscriber(node, arguments[0], on_message).subscribe()
        await node.closed.wait()
        return 0
