"""Topics of RotorS' plugins."""

from trundle.robots.parameters import TagParameters


def join_topic(parameters: TagParameters, topic: str) -> str:
    """Global name of a topic, below <robotNamespace>."""
    namespace = parameters.text("robotNamespace", "").strip("/")
    return f"/{namespace}/{topic.strip('/')}" if namespace else f"/{topic.strip('/')}"


def read_topic_name(parameters: TagParameters, name: str, default: str) -> str:
    """Global name of the topic that a parameter names."""
    return join_topic(parameters, parameters.text(name, default))
