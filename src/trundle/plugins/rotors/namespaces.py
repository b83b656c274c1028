"""Where RotorS' plugins have their topics."""

from trundle.model import PluginTag


def topic_in(tag: PluginTag, topic: str) -> str:
    """A topic's global name, below <robotNamespace>."""
    namespace = tag.node.string("robotNamespace").strip("/")
    return f"/{namespace}/{topic.strip('/')}" if namespace else f"/{topic.strip('/')}"


def topic_of(tag: PluginTag, name: str, default: str) -> str:
    """The global name of the topic that a parameter names."""
    return topic_in(tag, tag.node.string(name, default=default))
