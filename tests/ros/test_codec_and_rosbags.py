"""The C++ codec against rosbags' code, for every known type."""

import dataclasses
import math
import random
import struct
from typing import Any

import numpy as np
import pytest
from rosbags.interfaces import Nodetype
from rosbags.serde import SerdeError
from rosbags.serde.utils import SIZEMAP

from trundle.ros import MessageError, Messages

REFUSALS = (SerdeError, struct.error, ValueError)
RANGES = {
    "bool": (0, 1),
    "byte": (-(2**7), 2**7 - 1),
    "char": (0, 2**8 - 1),
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
}
REALS = [0.0, -0.0, 1.5, -2.25, 3.4e38, 1e-45, math.inf, -math.inf, math.nan]
TEXTS = ["", "map", "a longer frame_id, past the short ones", "Räder", "車輪", "🤖\0\n", "x" * 3000]
DTYPES = {"bool": "?", "byte": "i1", "char": "u1"}


@pytest.fixture(scope="module")
def messages() -> Messages:
    return Messages()


@pytest.fixture(scope="module")
def types(messages: Messages) -> list[str]:
    """All message types, including requests and responses of services."""
    services = [messages.service(name) for name in messages.service_names()]
    return messages.type_names() + [part for kind in services for part in (kind.request, kind.response)]


class MessageGenerator:
    """Generator of random messages, with all values that fields may have."""

    def __init__(self, store: Any, seed: int) -> None:
        self.store = store
        self.random = random.Random(seed)

    def message(self, key: str) -> Any:
        message = self.store.types[key].__new__(self.store.types[key])
        for name, desc in self.store.get_msgdef(key).fields:
            setattr(message, name, self.value(desc))
        return message

    def value(self, desc: Any) -> Any:
        kind, detail = desc
        if kind == Nodetype.NAME:
            return self.message(detail)
        if kind == Nodetype.BASE:
            return self.scalar(detail[0])
        (inner, of), count = detail
        if kind == Nodetype.SEQUENCE:
            count = self.random.choice([0, 1, 2, 3])
        if inner == Nodetype.BASE and of[0] != "string":
            if kind == Nodetype.SEQUENCE:
                count = self.random.choice([0, 1, 7, 400])
            return np.array([self.scalar(of[0]) for _ in range(count)], DTYPES.get(of[0], of[0]))
        return [self.value((inner, of)) for _ in range(count)]

    def scalar(self, kind: str) -> Any:
        if kind == "string":
            return self.random.choice(TEXTS)
        if kind.startswith("float"):
            number = self.random.choice([*REALS, self.random.gauss(0, 100)])
            return float(np.float32(number)) if kind == "float32" else number
        low, high = RANGES[kind]
        number = self.random.choice([low, high, self.random.randint(low, high)])
        return bool(number) if kind == "bool" else number


def same(one: Any, other: Any) -> bool:
    """Return True if two values are equal to the last bit."""
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        layout = (one.dtype, one.shape, one.flags.writeable, one.tobytes())
        return layout == (other.dtype, other.shape, other.flags.writeable, other.tobytes())
    if isinstance(one, float):
        return struct.pack("d", one) == struct.pack("d", other)
    if isinstance(one, list):
        return len(one) == len(other) and all(map(same, one, other))
    if hasattr(one, "__msgtype__"):
        names = [field.name for field in dataclasses.fields(one)]
        return all(same(getattr(one, name), getattr(other, name)) for name in names)
    return one == other


def read_by_rosbags(store: Any, data: Any, key: str) -> Any:
    """Return a message; None if rosbags refuses the data."""
    try:
        return store.deserialize_ros1(data, key)
    except REFUSALS:
        return None


def read_by_trundle(messages: Messages, data: Any, kind: str) -> Any:
    try:
        return messages.deserialize(data, kind)
    except MessageError:
        return None


def damaged(data: bytes, source: random.Random) -> list[bytes]:
    """Return damaged copies of bytes: truncated, extended and with other values."""
    results = [data[: source.randrange(len(data) + 1)] for _ in range(4)] + [data + b"\0", data[1:]]
    for _ in range(8):
        changed = bytearray(data or b"\0")
        for _ in range(source.randint(1, 3)):
            changed[source.randrange(len(changed))] = source.choice([0, 1, 4, 0x7F, 0x80, 0xFF, source.randrange(256)])
        results.append(bytes(changed))
    offset = source.randrange(len(data) + 1)  # a length of nearly 2^32, or one just too long
    return [
        *results,
        data[:offset] + b"\xff\xff\xff\xff" + data[offset + 4 :],
        data[:offset] + b"\1" + data[offset + 1 :],
    ]


@pytest.mark.parametrize("seed", range(3))
def test_bytes_and_values_match_rosbags(messages: Messages, types: list[str], seed: int) -> None:
    store = messages._store
    generator = MessageGenerator(store, seed)
    for kind in types:
        key = messages._key(kind)
        message = generator.message(key)
        data = bytes(store.serialize_ros1(message, key))

        assert messages.serialize(message) == data, kind
        framed = b"".join(messages.codec(kind).frame(message))
        assert framed == len(data).to_bytes(4, "little") + data, kind
        buffers: list[Any] = [data, bytearray(data), memoryview(data), memoryview(b"12" + data)[2:]]
        for buffer in buffers:
            read = messages.deserialize(buffer, kind)
            assert same(read, store.deserialize_ros1(buffer, key)), kind
            assert messages.serialize(read) == data, kind  # whose arrays may be unaligned


@pytest.mark.parametrize("seed", range(3))
def test_damaged_bytes_are_refused_like_in_rosbags(messages: Messages, types: list[str], seed: int) -> None:
    store = messages._store
    generator = MessageGenerator(store, seed)
    for kind in types:
        key = messages._key(kind)
        for data in damaged(bytes(messages.serialize(generator.message(key))), generator.random):
            assert same(read_by_trundle(messages, data, kind), read_by_rosbags(store, data, key)), (kind, data)


def test_the_types_have_fields_of_every_primitive_type(messages: Messages, types: list[str]) -> None:
    store = messages._store
    descs = [desc for kind in types for _, desc in store.fielddefs[messages._key(kind)][1]]
    inner = [desc if desc[0] in (Nodetype.BASE, Nodetype.NAME) else desc[1][0] for desc in descs]
    primitives = {desc[1][0] for desc in inner if desc[0] == Nodetype.BASE}
    assert primitives == set(SIZEMAP) - {"float128"} | {"string"}
