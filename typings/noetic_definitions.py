"""Makes src/trundle/assets/messages/standard: the message types of rosbags as text, one file per package, no comments.

    python typings/noetic_definitions.py

rospy's message classes are made from these, since importing rosbags takes longer than a node's whole start.
"""

from collections import defaultdict
from pathlib import Path

from rosbags.typesys import Stores, get_typestore

from trundle.ros import Messages

TARGET = Path(__file__).parents[1] / "src/trundle/assets/messages/standard"
SEPARATOR = "=" * 80


def bundles() -> dict[str, str]:
    """Text of each package's file."""
    messages = Messages()
    texts: dict[str, list[str]] = defaultdict(list)
    for key in sorted(get_typestore(Stores.ROS1_NOETIC).types):
        package, _, name = key.partition("/msg/")
        if package != "builtin_interfaces":
            texts[package].append(f"MSG: {package}/{name}\n{_text(messages, f'{package}/{name}')}")
    return {package: f"{SEPARATOR}\n".join(parts) for package, parts in texts.items()}


def _text(messages: Messages, type_name: str) -> str:
    constants = (f"{kind} {name}={value}\n" for name, (kind, value) in messages.constants(type_name).items())
    return "".join([*constants, *(f"{kind} {name}\n" for name, kind in messages.fields(type_name).items())])


if __name__ == "__main__":
    TARGET.mkdir(parents=True, exist_ok=True)
    for package, text in bundles().items():
        (TARGET / f"{package}.txt").write_text(text)
