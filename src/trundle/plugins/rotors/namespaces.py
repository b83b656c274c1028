"""Topics of RotorS' plugins."""

from trundle.model import PluginTag


def join_topic(tag: PluginTag, topic: str) -> str:
    """Global name of a topic, below <robotNamespace>."""
    namespace = tag.node.string("robotNamespace").strip("/")
    return f"/{namespace}/{topic.strip('/')}" if namespace else f"/{topic.strip('/')}"


def read_topic_name(tag: PluginTag, name: str, default: str) -> str:
    """Global name of the topic that a parameter names."""
    return join_topic(tag, tag.node.string(name, default=default))
