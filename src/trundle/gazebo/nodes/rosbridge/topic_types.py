"""Types of topics, as the master knows them."""

from trundle.ros import Node

from .errors import TopicNotEstablishedError, TypeConflictError

_ANY = "*"


async def resolve_type(node: Node, topic: str, given: str | None) -> str:
    """Type of a topic: the given one, or that which the master knows.

    Raises:
        RosbridgeError: none is known, or the topic has another type.
    """
    known = dict(await node.master.call("getTopicTypes")).get(node.resolve(topic), _ANY)
    if given is None and known == _ANY:
        raise TopicNotEstablishedError(topic)
    plain = str(known) if given is None else given.replace("/msg/", "/")
    if known not in (_ANY, plain):
        raise TypeConflictError(topic, str(known), plain)
    return plain
