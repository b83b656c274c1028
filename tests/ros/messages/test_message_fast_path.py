"""The message fast path makes the same messages, and refuses the same values, as the message builder."""

import random
from typing import Any

import numpy as np
import pytest
from rosbags.interfaces import Nodetype

from trundle.ros import MessageError, Messages
from trundle.ros.messages.message_builder import MessageBuilder

ODD: list[Any] = [
    *(None, "auto", "now", True, 1, -1, 1.5, 2**70, "x", b"\1\2", [], [1, 2], ["a"], ("a",), {}, {"secs": 3}, object),
    *(np.float64(2), np.int8(-3), np.bool_(True), np.zeros(3), np.arange(9), np.eye(3), {"no such": 1}),
]


@pytest.fixture(scope="module")
def messages() -> Messages:
    messages = Messages()
    messages.add("x_msgs/Word", "uint8 from\nuint8 None\nbool[] flags\nbyte[2] bytes\nchar[] chars")
    messages.add("x_msgs/Leaf", "string name")
    messages.add("x_msgs/Tree", "string name\nx_msgs/Leaf[] leaves")
    return messages


class Maker:
    """Generator of users' values for a message: mostly valid, in all the ways they may be written."""

    def __init__(self, store: Any, seed: int, oddities: float) -> None:
        self.store, self.oddities = store, oddities
        self.any = random.Random(seed)

    def message(self, key: str, depth: int = 0) -> Any:
        if depth > 6:
            return {}
        if key.startswith("builtin_interfaces/"):
            return self.any.choice([5, 10**18 + 1, {"secs": 1, "nsecs": 2}, self.store.types[key](3, 4), (5, 6)])
        fields = [field for field in self.store.fielddefs[key][1] if not field[0].startswith("structure_needs")]
        values = {name: self.value(desc, depth) for name, desc in fields}
        match self.any.randrange(4):
            case 0:
                return list(values.values())
            case 1:
                return {name: value for name, value in values.items() if self.any.random() < 0.5}
            case _:
                return values

    def value(self, desc: Any, depth: int) -> Any:
        kind, detail = desc
        if self.any.random() < self.oddities:
            return self.any.choice(ODD)
        if kind == Nodetype.NAME:
            return self.message(detail, depth + 1)
        if kind == Nodetype.BASE:
            return self.scalar(detail[0])
        inner, count = detail
        count = count if kind == Nodetype.ARRAY else self.any.randrange(3)
        values = [self.value(inner, depth) for _ in range(count)]
        return self.any.choice([list, tuple])(values)

    def scalar(self, kind: str) -> Any:
        if kind == "string":
            return self.any.choice(["", "map"])
        if kind == "bool":
            return self.any.choice([True, False])
        return self.any.choice([0.5, 2, np.float32(1.5)]) if kind.startswith("float") else self.any.randrange(100)


def _made(make: Any) -> Any:
    """Result as text, with types and bits."""
    try:
        return _text(make())
    except MessageError as error:
        return str(error)
    except (OverflowError, TypeError, ValueError) as error:  # of numpy, for arrays that are none
        return type(error)


def _text(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape} {value.tobytes()!r}"  # pyright: ignore[reportUnknownMemberType]
    if isinstance(value, list):
        return f"[{', '.join(map(_text, value))}]"  # pyright: ignore[reportUnknownArgumentType]
    if hasattr(value, "__msgtype__"):
        return f"{value.__msgtype__} { ({name: _text(field) for name, field in vars(value).items()}) }"
    return f"{type(value).__name__} {value!r}"


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("oddities", [0.0, 0.01, 0.2])
def test_what_is_made_quickly_is_what_is_made_slowly(messages: Messages, seed: int, oddities: float) -> None:
    store = messages._store  # pyright: ignore[reportPrivateUsage]
    filling, maker = MessageBuilder(store), Maker(store, seed, oddities)
    for kind in [*messages.type_names(), "x_msgs/Word", "x_msgs/Tree"]:
        key = messages._key(kind)  # pyright: ignore[reportPrivateUsage]
        given = maker.message(key)
        slowly = _made(lambda: filling._message(key, given, 7, ""))  # pyright: ignore[reportPrivateUsage]  # noqa: B023
        assert _made(lambda: messages.new(kind, given, now_ns=7)) == slowly, (kind, given)  # noqa: B023


def test_a_message_made_of_another_shares_nothing_with_it(messages: Messages) -> None:
    first = messages.new("geometry_msgs/TwistStamped", {"header": {"stamp": 5}, "twist": [[1.0, 2, 3], [4, 5, 6]]})
    second = messages.new("geometry_msgs/TwistStamped", first)
    assert second == first
    second.header.stamp.sec, second.twist.linear.x = 9, 9.0
    assert (first.header.stamp.sec, first.twist.linear.x) == (0, 1.0)


def test_an_array_given_as_a_list_shares_nothing_with_it(messages: Messages) -> None:
    given = [1.0, 2.0]
    message = messages.new("std_msgs/Float64MultiArray", {"data": given})
    given[0] = 5.0
    assert message.data.tolist() == [1.0, 2.0]
    assert message.data.flags.writeable


def test_what_is_wrong_within_a_list_is_named(messages: Messages) -> None:
    tree = messages.new("x_msgs/Tree", {"name": "a", "leaves": [{"name": "b"}, ["c"]]})
    assert [leaf.name for leaf in tree.leaves] == ["b", "c"]
    with pytest.raises(MessageError, match=r"field 'leaves\[0\].name' is a string, got 5"):
        messages.new("x_msgs/Tree", {"leaves": [{"name": 5}]})
