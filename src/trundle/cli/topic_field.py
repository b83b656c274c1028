"""Waits for the topic that a name, with or without a field behind it, means."""

import sys
import time

from trundle.ros import Field, MasterProxy, split_topic

_POLL_S = 0.1


def wait_for_topic(proxy: MasterProxy, name: str) -> Field:
    """Find the topic that a name, with or without a field behind it, means; wait until there is one."""
    warned = False
    while True:
        types = {topic: kind for topic, kind in proxy.call("getTopicTypes") if kind != "*"}
        found = split_topic(name, types)
        if found is not None:
            return Field(topic=found[0], type=types[found[0]], path=found[1])
        if not warned:
            warned = True
            print(f"WARNING: topic [{name}] does not appear to be published yet", file=sys.stderr, flush=True)
        time.sleep(_POLL_S)
