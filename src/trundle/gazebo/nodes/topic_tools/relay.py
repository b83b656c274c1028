"""topic_tools/relay: republishes a topic under another name."""

import asyncio

from trundle.ros import Node, RawMessage

from ..host import NodeHost
from ..private_parameters import private_parameters
from .raw_relay import RawPublisher, RawSubscriber, subscribe_lazily

_USAGE = "usage: relay IN_TOPIC [OUT_TOPIC]"


class Relay:
    """Relays messages; with ~lazy only while there are subscribers, with ~stealth only while other nodes subscribe."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Relay until cancelled."""
        node = self._node
        if not 1 <= len(self._arguments) <= 2:
            node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 1
        source, target = (*self._arguments, f"{self._arguments[0]}_relay")[:2]
        settings = await private_parameters(node)
        is_stealthy = settings.flag("stealth", default=False)
        output = RawPublisher(node, target)

        def relay(message: RawMessage) -> None:
            is_first = not output.is_typed
            output.publish(message)
            if is_first and is_stealthy:  # until the next check; interim subscribers receive nothing
                subscriber.unsubscribe()

        subscriber = RawSubscriber(node, source, relay)
        subscriber.subscribe()
        if is_stealthy:
            monitored = node.resolve(settings.text("monitor_topic", source))
            await self._relay_stealthily(subscriber, output, monitored, period_s=settings.number("monitor_rate", 1.0))
        elif settings.flag("lazy", default=False):
            await subscribe_lazily(node, output, lambda: [(subscriber, True)])
        await node.closed.wait()
        return 0

    async def _relay_stealthily(
        self, subscriber: RawSubscriber, output: RawPublisher, monitored: str, *, period_s: float
    ) -> None:
        """Subscribe only while another node subscribes to `monitored`, checked every `period_s` (the original: a rate).

        The node stays subscribed until the first message, which determines the output's type.
        """
        node = self._node
        call = node.master.call
        while not node.closed.is_set():
            _, subscribers, _ = await call("getSystemState")
            call = node.master.poll
            if not output.is_typed or any(
                topic == monitored and set(nodes) - {node.name} for topic, nodes in subscribers
            ):
                subscriber.subscribe()
            else:
                subscriber.unsubscribe()
            await asyncio.sleep(max(period_s, 0.1))
