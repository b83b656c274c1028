"""Messages of any type, as bytes."""

from tests.graphs import Graph

from trundle.ros import RawMessage


def test_a_long_message_of_another_process_is_not_copied(far: Graph, graph: Graph) -> None:
    """It stays in its receive buffer, which is never written again."""
    talker, listener = far.node("talker"), graph.node("listener")
    received: list[RawMessage] = []
    listener.subscribe("/cloud", "*", received.append)
    publisher = talker.advertise("/cloud", "std_msgs/UInt8MultiArray")
    graph.until(lambda: publisher.has_subscribers)
    for count, size in enumerate((10, 40_000_000, 20_000_000), start=1):
        publisher.publish({"data": bytes([size % 251]) * size})
        graph.until(lambda count=count: len(received) == count)

    for message, size in zip(received, (10, 40_000_000, 20_000_000), strict=True):
        assert bytes(message.data[-size:]) == bytes([size % 251]) * size
    assert isinstance(received[1].data, memoryview)
    assert received[1].data.readonly
