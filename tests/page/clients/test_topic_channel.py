"""The subscription of a topic's channel, with a node that counts."""

import asyncio
from typing import Any, cast

import pytest

from trundle.page.clients import topic_channel
from trundle.page.clients.channel import Client
from trundle.page.clients.topic_channel import TopicChannel
from trundle.ros import Node


class CountingNode:
    """Counts subscriptions that start and end."""

    def __init__(self) -> None:
        self.started = self.ended = 0

    def subscribe(self, *_: Any, **__: Any) -> "CountingNode":
        self.started += 1
        return self

    def unregister(self) -> None:
        self.ended += 1


async def _visit(node: CountingNode, *, again: bool) -> None:
    """Subscribe, unsubscribe, optionally resubscribe at once, and wait longer than a subscription lingers."""
    channel = TopicChannel(
        "/a", "a/B", md5sum="", definition="", is_certain=True, now_ns=lambda: 0, retype=lambda *_: None
    )
    channel.set_node(cast(Node, node))
    client = cast(Client, object())
    channel.subscribe(client)
    channel.unsubscribe(client)
    if again:
        channel.subscribe(client)
    await asyncio.sleep(0.1)


@pytest.mark.parametrize(("again", "ended"), [(True, 0), (False, 1)])
def test_a_subscription_outlives_its_last_client_for_a_while(
    again: bool, ended: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Otherwise messages would be lost between two connections; without clients, it ends a little later."""
    monkeypatch.setattr(topic_channel, "_LINGER_S", 0.02)
    node = CountingNode()

    asyncio.run(_visit(node, again=again))

    assert (node.started, node.ended) == (1, ended)
