"""Topics in expressions, by their last message."""

import re
from functools import partial

from trundle.base.diagnostics import UsageError
from trundle.ros import Node, RawMessage

from .plan import Plan

_NAMED = re.compile(r"""\btopics\s*\[\s*(["'])([^"']+)\1\s*\]""")


class NoMessageError(UsageError):
    """Error for a topic without a message so far."""


class SilentTopic:
    """Topic without a message so far; reading a field raises NoMessageError."""

    def __init__(self, topic: str) -> None:
        self.topic = topic


class TopicReader:
    """Subscriber of the topics that a plan names."""

    def __init__(self, node: Node, topics: list[str]) -> None:
        self._messages, self._topics = node.messages, topics
        self._last: dict[str, RawMessage] = {}
        for topic in topics:
            node.subscribe(topic, "*", partial(self._last.__setitem__, topic), queue_size=1, on_loop=True)

    def messages(self) -> dict[str, object]:
        """Return the last message of each topic."""
        return {topic: self._message(topic) for topic in self._topics}

    def _message(self, topic: str) -> object:
        raw = self._last.get(topic)
        if raw is None:
            return SilentTopic(topic)
        self._messages.add_definition(raw.type, raw.definition)
        return self._messages.deserialize(raw.data, raw.type)


def topics_of(plan: Plan) -> list[str]:
    """Return the topics in a plan's expressions, such as `topics["/odom"]`."""
    texts = [item.expression or "" for item in plan.measures] + [item.text for item in plan.stop]
    return sorted({match[1] for text in texts for match in _NAMED.findall(text)})
