"""Namespaces, topics and update rates of gazebo_ros plugins."""

from trundle.names import ros_name
from trundle.parameters import TagParameters

WITHOUT_EFFECT = ("rosDebugLevel", "alwaysOn", "robotNamespace", "always_on", "update_rate")
"""Parameters that any plugin of gazebo_ros may have and that mean nothing here."""


def read_namespace(parameters: TagParameters, model: str) -> str:
    """<robotNamespace> without slashes at its ends; if present and empty the model's name, as in gazebo_ros."""
    namespace = parameters.text("robotNamespace", "/")
    return namespace.strip("/") if namespace else ros_name(model)


def join_topic(namespace: str, topic: str) -> str:
    """Global name of a topic."""
    if topic.startswith("/") or not namespace:
        return f"/{topic.lstrip('/')}"
    return f"/{namespace}/{topic}"


def rate_to_period_ns(rate_hz: float) -> int:
    """Period of an update rate [ns]; 0: every step."""
    return round(1e9 / rate_hz) if rate_hz > 0.0 else 0
