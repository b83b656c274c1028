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
        node, words = self._node, self._arguments
        counts = [int(word) for word in words[1:3] if word.isdecimal()]
        if not 3 <= len(words) <= 4 or len(counts) != 2 or counts[1] < 1:
            node.log.error(f"{_USAGE}; got {' '.join(words)!r}")
            return 1
        output = RawPublisher(node, words[3] if len(words) > 3 else f"{words[0]}_drop")
        dropped, every = counts
        count = 0

        def on_message(message: RawMessage) -> None:
            nonlocal count
            if count >= dropped:
                output.publish(message)
            count = (count + 1) % every

        RawSubscriber(node, words[0], on_message).subscribe()
        await node.closed.wait()
        return 0
