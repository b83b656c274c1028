"""Wait for a topic, given by name or field path."""

import sys
import time

from trundle.base.diagnostics import UsageError
from trundle.ros import MasterProxy, Messages, TopicField, field_type, split_topic

_POLL_S = 0.1


def wait_for_topic(proxy: MasterProxy, name: str, messages: Messages) -> TopicField:
    """Wait for a topic, and return it with the field path."""
    warned = False
    while True:
        types = {topic: kind for topic, kind in proxy.call("getTopicTypes") if kind != "*"}
        match = split_topic(name, types)
        detail = ""
        if match is not None:
            field = TopicField(topic=match[0], type=types[match[0]], path=match[1])
            try:
                if field.path and messages.has(field.type):
                    field_type(field.type, field.path, messages)
                return field
            except UsageError as error:  # beside /imu, a topic /imu/data may appear later
                detail = f"; {field.topic} is: {error}"
        if not warned:
            warned = True
            print(f"WARNING: topic [{name}] does not appear to be published yet{detail}", file=sys.stderr, flush=True)
        time.sleep(_POLL_S)
