"""Keyboard topic `/keyboard/keypress`, which replaces `~/keyboard/keypress` of Gazebo's window.

A key is a std_msgs/Int32: its character code, or Qt's key code (16777234 left, …35 up, …36 right, …37 down).
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import PluginTag
from trundle.ros import Node

if TYPE_CHECKING:
    from trundle.ros.message_types import std_msgs

KEYS_TOPIC = "/keyboard/keypress"


def subscribe_keys(node: Node | None, tag: PluginTag, on_key: Callable[[int], None], report: Diagnostics) -> None:
    """Call a function with each key; warn if there is no node."""
    if node is None:
        report.warn(
            tag.at, f"plugin {tag.name!r} reads keys from a ROS topic, which --no-ros leaves out", "plugin-needs-ros"
        )
        return

    def on_message(message: "std_msgs.Int32") -> None:
        on_key(int(message.data))

    node.subscribe(KEYS_TOPIC, "std_msgs/Int32", on_message)
    report.info(tag.at, f"plugin {tag.name!r} reads keys from the topic {KEYS_TOPIC} (std_msgs/Int32)", "plugin-keys")
