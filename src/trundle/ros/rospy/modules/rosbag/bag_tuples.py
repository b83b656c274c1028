"""Named tuples of bags: messages, types, topics and compression."""

from collections.abc import Sequence
from itertools import pairwise
from statistics import median
from typing import Any, NamedTuple

import rospy


class BagMessage(NamedTuple):
    """Message of a bag."""

    topic: str
    message: Any
    timestamp: rospy.Time


class BagMessageWithConnectionHeader(NamedTuple):
    """Message of a bag, with the header of its connection."""

    topic: str
    message: Any
    timestamp: rospy.Time
    connection_header: dict[str, bytes]


class TopicTuple(NamedTuple):
    """Topic of a bag."""

    msg_type: str
    message_count: int
    connections: int
    frequency: float | None


class TypesAndTopicsTuple(NamedTuple):
    """Types (type → MD5) and topics (name → TopicTuple) of a bag."""

    msg_types: dict[str, str]
    topics: dict[str, TopicTuple]


class CompressionTuple(NamedTuple):
    """Compression of a bag, and sizes [bytes]."""

    compression: str
    uncompressed: int
    compressed: int


def median_frequency(stamps_ns: Sequence[int]) -> float | None:
    """Median frequency [Hz]; None for fewer than two messages, or if most have the same stamp."""
    periods = [(b - a) / 1e9 for a, b in pairwise(stamps_ns)]
    period = median(periods) if periods else 0.0
    return 1.0 / period if period > 0.0 else None
