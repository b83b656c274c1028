"""Lists of numbers in array fields: written like arrays; an invalid number is reported."""

import gc
import math
import sys
from collections import UserList
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from trundle.ros import MessageError, Messages

EDGES: dict[str, list[Any]] = {
    "bool": [True, False],
    "byte": [-(2**7), 2**7 - 1],
    "char": [0, 2**8 - 1],
    **{f"int{bits}": [-(2 ** (bits - 1)), 0, 2 ** (bits - 1) - 1] for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": [0, 2**bits - 1] for bits in (8, 16, 32, 64)},
    "float32": [0.0, -0.0, 1.5, 1e-45, 3.4e38, math.inf, -math.inf, math.nan, 7, 2**53],
    "float64": [0.0, -0.0, 0.1, 5e-324, 1.7e308, math.inf, math.nan, 7, -(2**53)],
}
DTYPES = {"bool": "?", "byte": "i1", "char": "u1"}


@pytest.fixture(scope="module")
def messages() -> Messages:
    messages = Messages()
    for kind in EDGES:
        messages.add(f"x_msgs/{kind.title()}s", f"uint8 before\n{kind}[] data\nuint8 behind")
    messages.add("x_msgs/Three", "float64[3] data")
    messages.add("x_msgs/Many", "x_msgs/Three[] data")
    return messages


def _message(messages: Messages, kind: str, data: Any) -> Any:
    message = messages.new(f"x_msgs/{kind}")
    message.data = data
    return message


@pytest.mark.parametrize("kind", EDGES)
@pytest.mark.parametrize("count", [0, 1, 7, 5000])
def test_a_list_is_written_like_an_equal_array(messages: Messages, kind: str, count: int) -> None:
    numbers = (EDGES[kind] * count)[:count]
    name, array = f"{kind.title()}s", np.array(numbers, DTYPES.get(kind, kind))

    written = messages.serialize(_message(messages, name, array))

    for values in (numbers, tuple(numbers), UserList(numbers), list(array)):
        message = _message(messages, name, values)
        assert messages.serialize(message) == written
        assert b"".join(messages.codec(f"x_msgs/{name}").frame(message))[4:] == written
        assert message.data is values


@pytest.mark.parametrize("kind", EDGES)
def test_plain_numbers_need_no_conversion(messages: Messages, kind: str) -> None:
    name = f"{kind.title()}s"
    message = _message(messages, name, EDGES[kind])
    assert messages.codec(f"x_msgs/{name}").exact_frame(message)


@pytest.mark.parametrize(
    ("kind", "numbers", "expected"),
    [
        ("Float64", [True, 1], [1.0, 1.0]),
        ("Float64", [Fraction(1, 2), 1], [0.5, 1.0]),
        ("Float64", [2**60 + 1, 10**30], [2.0**60, 1e30]),
        ("Float64", [np.float32(0.1), np.int16(3)], [float(np.float32(0.1)), 3.0]),
        ("Float32", [2**54 + 2**30 + 1], [2.0**54 + 2.0**31]),
        ("Int16", [True, np.int64(-3)], [1, -3]),
        ("Uint64", [2**64 - 1, np.uint8(1)], [2**64 - 1, 1]),
        ("Bool", [1, 0, True], [True, False, True]),
        ("Bool", [1, 0], [True, False]),
    ],
)
def test_numbers_of_other_types_are_converted(
    messages: Messages, kind: str, numbers: list[Any], expected: list[Any]
) -> None:
    data = messages.serialize(_message(messages, f"{kind}s", numbers))
    assert messages.deserialize(data, f"x_msgs/{kind}s").data.tolist() == expected
    assert messages.new(f"x_msgs/{kind}s", {"data": numbers}).data.tolist() == expected


@pytest.mark.parametrize(
    ("kind", "numbers", "reason"),
    [
        ("Uint8s", [1, 256], r"field 'data\[1\]' is a uint8 \(0 to 255\), got 256"),
        ("Uint8s", [-1], r"field 'data\[0\]' is a uint8 \(0 to 255\), got -1"),
        ("Int64s", [0, 0, 2**63], r"field 'data\[2\]' is a int64"),
        ("Uint64s", [-1], r"field 'data\[0\]' is a uint64"),
        ("Uint64s", [10**40], r"field 'data\[0\]' is a uint64"),
        ("Int32s", [1, 2.0], r"field 'data\[1\]' is a int32, got 2.0"),
        ("Int32s", [None], r"field 'data\[0\]' is a int32, got None"),
        ("Bools", [True, 2], r"field 'data\[1\]' is a bool, got 2"),
        ("Float64s", [0.5, "1"], r"field 'data\[1\]' is a float64, got '1'"),
        ("Float64s", [0.5, None], r"field 'data\[1\]' is a float64, got None"),
        ("Float64s", [[0.5]], r"field 'data\[0\]' is a float64, got \[0.5\]"),
        ("Float64s", [10**400], "cannot serialize a x_msgs/Float64s: int too large"),
        ("Three", [1.0, 2.0], "field 'data' has exactly 3 elements, got 2"),
        ("Three", [1.0] * 4, "field 'data' has exactly 3 elements, got 4"),
    ],
)
def test_an_invalid_number_is_reported(messages: Messages, kind: str, numbers: list[Any], reason: str) -> None:
    with pytest.raises(MessageError, match=reason):
        messages.serialize(_message(messages, kind, numbers))


def test_an_invalid_number_in_a_list_of_messages_is_reported(messages: Messages) -> None:
    many = messages.new("x_msgs/Many", {"data": [[[1.0, 2.0, 3.0]], [[4.0, 5.0, 6.0]]]})
    many.data[1].data = [4.0, 5.0, "six"]
    with pytest.raises(MessageError, match=r"field 'data\[1\].data\[2\]' is a float64, got 'six'"):
        messages.serialize(many)


class _ClearingNumber:
    """Number that empties its list when it is converted."""

    def __init__(self, numbers: list[Any]) -> None:
        self.numbers = numbers

    def __float__(self) -> float:
        self.numbers.clear()
        gc.collect()
        return 1.0

    def __index__(self) -> int:
        return int(float(self))


@pytest.mark.parametrize("kind", ["Float64s", "Uint8s", "Bools"])
def test_a_list_that_changes_during_serialization_is_refused(messages: Messages, kind: str) -> None:
    numbers: list[Any] = []
    numbers += [True, _ClearingNumber(numbers), *[True] * 100]
    with pytest.raises(MessageError):
        messages.serialize(_message(messages, kind, numbers))


def test_serializing_lists_leaks_no_memory(messages: Messages) -> None:
    valid = _message(messages, "Float64s", [float(i) for i in range(300)])
    invalid = _message(messages, "Float64s", [*(float(i) for i in range(300)), "x"])

    def write_both() -> None:
        for _ in range(300):
            messages.serialize(valid)
            with pytest.raises(MessageError):
                messages.serialize(invalid)

    def blocks() -> int:
        gc.collect()
        return sys.getallocatedblocks()

    write_both()
    before = blocks()
    write_both()
    assert blocks() - before < 300
