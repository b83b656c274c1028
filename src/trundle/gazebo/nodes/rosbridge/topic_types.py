"""Types of topics, from the master."""

from trundle.ros import Node

from .errors import TopicNotEstablishedError, TypeConflictError

_ANY = "*"


async def resolve_type(node: Node, topic: str, requested: str | None) -> str:
    """Return the type of a topic: the requested one, or the master's.

    Raises:
        RosbridgeError: the type is unknown, or the topic has another.
    """
    established = dict(await node.master.call("getTopicTypes")).get(node.resolve(topic), _ANY)
    if requested is None and established == _ANY:
        raise TopicNotEstablishedError(topic)
    kind = str(established) if requested is None else requested.replace("/msg/", "/")
    if established not in (_ANY, kind):
        raise TypeConflictError(topic, str(established), kind)
    return kind
