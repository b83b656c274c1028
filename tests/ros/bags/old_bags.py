"""Bags with outdated message types."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from trundle.ros import BagConnection, BagMessage, Messages, create_bag

SEPARATOR = "\n" + "=" * 80 + "\nMSG: "
OLD_POINT = "float64 x\nfloat64 y\n"
OLD_HEADER = f"{SEPARATOR}std_msgs/Header\ntime stamp\nstring frame\n"
Content = Sequence[tuple[str, str, str, Sequence[Mapping[str, Any]]]]
"""Topic, type, its definition, fields of each message."""


def write_old_bag(path: Path, content: Content) -> Path:
    """Write a bag; messages are 10 ms apart."""
    stamp_ns = 1_700_000_000_000_000_000
    with create_bag(path) as out:
        for topic, kind, text, messages in content:
            types = Messages(bare=True)
            types.add_definition(kind, text)
            connection = BagConnection(topic=topic, type=kind, md5sum=types.md5(kind), definition=text)
            for fields in messages:
                stamp_ns += 10_000_000
                data = bytes(types.serialize(types.new(kind, fields)))
                out.write(BagMessage(connection, stamp_ns, data))
    return path


def rule(name: str, old: tuple[str, str], new: tuple[str, str], *update: str, more: str = "") -> str:
    """Text of a rule: type and definition, before and after, and the lines of its update."""
    lines = [
        f"class {name}(MessageUpdateRule):",
        f"    old_type, old_full_text = {old!r}",
        f"    new_type, new_full_text = {new!r}",
        f"    order, migrated_types, valid = 0, [], True\n    {more}",
        "    def update(self, old_msg, new_msg):",
        *(f"        {line}" for line in update or ("pass",)),
    ]
    return "\n".join(lines) + "\n"
