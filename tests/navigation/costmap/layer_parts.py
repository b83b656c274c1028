"""A node of a few lines, and sources that saw what a test says."""

import logging
from types import SimpleNamespace
from typing import Any

import numpy as np

from trundle.navigation.costmap.observations import Observation, SourceSettings


class QuietNode:
    """Takes subscriptions and publishes nothing; `handlers` by topic."""

    def __init__(self) -> None:
        self.name = "/move_base"
        self.time_ns = 0
        self.handlers: dict[str, Any] = {}
        self.clock = SimpleNamespace(now_ns=lambda: self.time_ns)
        log = logging.getLogger("layers")
        self.log = SimpleNamespace(warn=log.warning, error=log.error, info=log.info)

    def subscribe(self, topic: str, kind: str, handler: Any, **options: Any) -> Any:
        del kind, options
        self.handlers[topic] = handler
        return SimpleNamespace(unregister=lambda: None)


def quiet_node() -> Any:
    return QuietNode()


def source(**settings: Any) -> Any:
    """Return a source that marks and clears; set its `seen`."""
    made = SimpleNamespace(settings=SourceSettings(clearing=True, **settings), is_current=True, seen=[])
    made.observations = lambda: made.seen
    made.clear = made.seen.clear
    return made


def saw(sensor: tuple[float, float, float], *points: tuple[float, float, float]) -> Observation:
    return Observation(0, sensor, np.array(points, dtype=float).reshape(-1, 3))
