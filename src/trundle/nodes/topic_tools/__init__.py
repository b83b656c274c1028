"""The nodes of topic_tools: messages of any type passed on, thinned out, chosen among or computed from."""

from .drop import Drop
from .mux import Mux
from .relay import Relay
from .throttle import Throttle
from .transform import Transform

__all__ = ["Drop", "Mux", "Relay", "Throttle", "Transform"]
