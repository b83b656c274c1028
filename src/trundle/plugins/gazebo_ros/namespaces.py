"""Namespaces, topics and update rates of gazebo_ros plugins."""

from trundle.diagnostics import Diagnostics
from trundle.model import PluginTag
from trundle.names import ros_name
from trundle.xmlnode import XmlNode

_NOTHING = {"0", "0.0", "false"}


def read_namespace(tag: PluginTag, model: str) -> str:
    """<robotNamespace> without slashes at its ends; if present and empty the model's name, as in gazebo_ros."""
    found = tag.node.find("robotNamespace")
    if found is None:
        return ""
    return found.text.strip().strip("/") or (ros_name(model) if not found.text.strip() else "")


def join_topic(namespace: str, topic: str) -> str:
    """Global name of a topic."""
    if topic.startswith("/") or not namespace:
        return f"/{topic.lstrip('/')}"
    return f"/{namespace}/{topic}"


def rate_to_period_ns(rate_hz: float) -> int:
    """Period of an update rate [ns]; 0: every step."""
    return round(1e9 / rate_hz) if rate_hz > 0.0 else 0


def mark_read(parameters: XmlNode, *names: str) -> None:
    """Mark parameters as read that have no meaning here, such as debug levels and ODE's settings."""
    for name in (*names, "rosDebugLevel", "alwaysOn", "robotNamespace", "always_on", "update_rate"):
        parameters.find(name)


def warn_unsupported(parameters: XmlNode, report: Diagnostics, *names: str) -> None:
    """Mark parameters as read, and warn of those that would have an effect."""
    for name in names:
        found = parameters.find(name)
        if found is not None and not set(found.text.split()) <= _NOTHING:
            report.warn(found.at, f"<{name}> is not supported")
