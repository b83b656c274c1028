"""The message fast path makes the same messages, and refuses the same values, as the message builder."""

import random
from typing import Any

import numpy as np
import pytest
from rosbags.interfaces import Nodetype

from trundle.ros import MessageError, Messages
from trundle.ros.messages.message_builder import MessageBuilder

UNUSUAL: list[Any] = [
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


class ValueGenerator:
    """Generator of random values for messages: mostly valid, in every accepted form."""

    def __init__(self, store: Any, seed: int, unusual_ratio: float) -> None:
        self.store, self.unusual_ratio = store, unusual_ratio
        self.random = random.Random(seed)

    def message(self, key: str, depth: int = 0) -> Any:
        if depth > 6:
            return {}
        if key.startswith("builtin_interfaces/"):
            return self.random.choice([5, 10**18 + 1, {"secs": 1, "nsecs": 2}, self.store.types[key](3, 4), (5, 6)])
        fields = [field for field in self.store.fielddefs[key][1] if not field[0].startswith("structure_needs")]
        values = {name: self.value(desc, depth) for name, desc in fields}
        match self.random.randrange(4):
            case 0:
                return list(values.values())
            case 1:
                return {name: value for name, value in values.items() if self.random.random() < 0.5}
            case _:
                return values

    def value(self, desc: Any, depth: int) -> Any:
        kind, detail = desc
        if self.random.random() < self.unusual_ratio:
            return self.random.choice(UNUSUAL)
        if kind == Nodetype.NAME:
            return self.message(detail, depth + 1)
        if kind == Nodetype.BASE:
            return self.scalar(detail[0])
        inner, count = detail
        count = count if kind == Nodetype.ARRAY else self.random.randrange(3)
        values = [self.value(inner, depth) for _ in range(count)]
        return self.random.choice([list, tuple])(values)

    def scalar(self, kind: str) -> Any:
        if kind == "string":
            return self.random.choice(["", "map"])
        if kind == "bool":
            return self.random.choice([True, False])
        return self.random.choice([0.5, 2, np.float32(1.5)]) if kind.startswith("float") else self.random.randrange(100)


def _result(make: Any) -> Any:
    """Return the message as text, with types and bytes, or its error."""
    try:
        return _text(make())
    except MessageError as error:
        return str(error)
    except (OverflowError, TypeError, ValueError) as error:  # raised by numpy for invalid arrays
        return type(error)


def _text(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape} {value.tobytes()!r}"
    if isinstance(value, list):
        return f"[{', '.join(map(_text, value))}]"
    if hasattr(value, "__msgtype__"):
        return f"{value.__msgtype__} { ({name: _text(field) for name, field in vars(value).items()}) }"
    return f"{type(value).__name__} {value!r}"


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("unusual_ratio", [0.0, 0.01, 0.2])
def test_the_fast_path_makes_the_same_messages_as_the_builder(
    messages: Messages, seed: int, unusual_ratio: float
) -> None:
    store = messages._store
    builder, generator = MessageBuilder(store), ValueGenerator(store, seed, unusual_ratio)
    for kind in [*messages.type_names(), "x_msgs/Word", "x_msgs/Tree"]:
        key = messages._key(kind)
        value = generator.message(key)
        expected = _result(lambda: builder._message(key, value, 7, ""))  # noqa: B023
        assert _result(lambda: messages.new(kind, value, now_ns=7)) == expected, (kind, value)  # noqa: B023


def test_a_message_made_from_another_is_a_deep_copy(messages: Messages) -> None:
    first = messages.new("geometry_msgs/TwistStamped", {"header": {"stamp": 5}, "twist": [[1.0, 2, 3], [4, 5, 6]]})
    second = messages.new("geometry_msgs/TwistStamped", first)
    assert second == first
    second.header.stamp.sec, second.twist.linear.x = 9, 9.0
    assert (first.header.stamp.sec, first.twist.linear.x) == (0, 1.0)


def test_an_array_field_copies_a_list(messages: Messages) -> None:
    value = [1.0, 2.0]
    message = messages.new("std_msgs/Float64MultiArray", {"data": value})
    value[0] = 5.0
    assert message.data.tolist() == [1.0, 2.0]
    assert message.data.flags.writeable


def test_an_error_in_a_list_names_the_element(messages: Messages) -> None:
    tree = messages.new("x_msgs/Tree", {"name": "a", "leaves": [{"name": "b"}, ["c"]]})
    assert [leaf.name for leaf in tree.leaves] == ["b", "c"]
    with pytest.raises(MessageError, match=r"field 'leaves\[0\].name' is a string, got 5"):
        messages.new("x_msgs/Tree", {"leaves": [{"name": 5}]})
