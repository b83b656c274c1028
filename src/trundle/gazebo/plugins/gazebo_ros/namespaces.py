"""Parameters that plugins of gazebo_ros share: topics, update rates, offsets."""

from collections.abc import Collection

from trundle.robots.parameters import TagParameters
from trundle.spatial import ZERO, Pose

WITHOUT_EFFECT = ("rosDebugLevel", "alwaysOn", "robotNamespace", "always_on", "update_rate")
"""Parameters that any plugin of gazebo_ros may have, without effect in Trundle."""


def join_topic(namespace: str, topic: str) -> str:
    """Return the global name of a topic."""
    if topic.startswith("/") or not namespace:
        return f"/{topic.lstrip('/')}"
    return f"/{namespace}/{topic}"


def rate_to_period_ns(rate_hz: float) -> int:
    """Return the period of an update rate [ns]; 0: every step."""
    return round(1e9 / rate_hz) if rate_hz > 0.0 else 0


def read_offset(parameters: TagParameters, names: Collection[str]) -> Pose:
    """Read the offsets in `names`, of <xyzOffset> and <rpyOffset>; many files spell them with an s at the end."""
    xyz, rpy = (
        parameters.vector(name, parameters.vector(f"{name}s", ZERO)) if name in names else ZERO
        for name in ("xyzOffset", "rpyOffset")
    )
    return Pose.from_rpy(*xyz, *rpy)
