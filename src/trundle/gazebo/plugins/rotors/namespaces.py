"""Topics of RotorS' plugins."""

from trundle.robots.parameters import TagParameters


def join_topic(parameters: TagParameters, topic: str) -> str:
    """Return the global name of a topic below <robotNamespace>."""
    namespace = parameters.text("robotNamespace", "").strip("/")
    return f"/{namespace}/{topic.strip('/')}" if namespace else f"/{topic.strip('/')}"


def read_topic_name(parameters: TagParameters, name: str, default: str) -> str:
    """Return the global name of the topic in a parameter."""
    return join_topic(parameters, parameters.text(name, default))
