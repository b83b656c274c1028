"""Keys that drive: where Gazebo's window sent `~/keyboard/keypress`, the ROS graph has a topic of the same name.

A key is a std_msgs/Int32: the character's number, or Qt's for others (16777234 left, …35 up, …36 right, …37 down).
"""

from collections.abc import Callable

from trundle.diagnostics import Diagnostics
from trundle.model import PluginTag
from trundle.ros import Message, Node

KEYS_TOPIC = "/keyboard/keypress"


def subscribe_keys(node: Node | None, tag: PluginTag, press: Callable[[int], None], report: Diagnostics) -> None:
    """Have a function called with each key; where none can come, that is said."""
    if node is None:
        report.warn(tag.at, f"plugin {tag.name!r} waits for keys, and without ROS there is no topic to bring them")
        return

    def on_message(message: Message) -> None:
        press(int(message.data))

    node.subscribe(KEYS_TOPIC, "std_msgs/Int32", on_message)
    report.info(tag.at, f"plugin {tag.name!r} takes keys from the topic {KEYS_TOPIC} (std_msgs/Int32)")
