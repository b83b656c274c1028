"""Mutations of inputs: bytes, numbers, words and elements, with the format's words and parts of other inputs."""

import json
import re
import struct
from collections.abc import Callable, Sequence
from random import Random
from typing import Any

_SPECIAL_WORDS = (
    b"", b"0", b"-1", b"1e400", b"nan", b"inf", b"-inf", b"3e38", b"1e308", b"1e-320", b"2147483648",
    b"-9223372036854775809", b"999999999999", b"true", b"/", b"//", b"~", b"..", b"../../x", b"\0", b"\xff\xfe",
    b"\xef\xbb\xbf", b"\xed\xa0\x80", b"\xc3\xa9", b"&#27;", b"&amp;", b"&x;", b"<", b"]]>", b"<!--", b'"', b"{",
    b"[", b"${", b"$(", b"$(find x)", b"${1/0}", b"model://m", b"package://p/x", b"file:///", b"!!python/name:os",
    b"*a", b"&a [*a, *a]", b"x" * 5000, b"[" * 500, b"\n", b"\r\n", b"1 2 3 4 5 6 7 8", b"::",
)  # fmt: skip
_SPECIAL_INTEGERS = (
    0, 1, -1, 2, 3, 7, 127, 128, 255, 256, 32767, 65535, 65536, 2**24, 2**31 - 1, 2**31, 2**32 - 1, 2**63,
)  # fmt: skip
_SPECIAL_FLOATS = (0.0, -0.0, 1.0, -1.0, 1e-45, 1e38, 3.4e38, float("inf"), float("-inf"), float("nan"))
_SPECIAL_VALUES: tuple[Any, ...] = (
    None, True, -1, 0, 1, 2**31, 2**32, 2**64, 10**30, 1e308, -0.5, float("nan"), "", "/", "~", "//", "a b", "é\0",
    "\ud800", "x" * 2000, [], {}, [[[]]], {"a": {"b": 1}}, "NaN", "std_msgs/Header", "no_msgs/None", "../../etc/passwd",
)  # fmt: skip
_DECODER = json.JSONDecoder()
_WORD = re.compile(rb"[^\s<>\"'=,;{}\[\]()\0]+")
_TAG = re.compile(rb"<([A-Za-z_:][\w:.-]*)")
_MAX_EDITS = 4
_MAX_SPAN = 200
_MAX_COPIES = 30

Edit = Callable[[bytes, "Pool", Random], bytes]


class Pool:
    """Material of mutations: words, and other inputs."""

    def __init__(self, words: Sequence[bytes], inputs: Sequence[bytes]) -> None:
        """Store words of the format, and inputs, at least one."""
        self.words = (*words, *_SPECIAL_WORDS)
        self.inputs = inputs


def mutate(data: bytes, pool: Pool, source: Random) -> bytes:
    """Return an input with one to four edits."""
    for _ in range(source.randint(1, _MAX_EDITS)):
        data = source.choice(_EDITS)(data, pool, source)
    return data


def _span(data: bytes, source: Random, max_size: int = _MAX_SPAN) -> tuple[int, int]:
    start = source.randint(0, len(data))
    return start, min(len(data), start + source.randint(0, source.choice((1, 4, 16, max_size))))


def _find(pattern: "re.Pattern[bytes]", data: bytes, source: Random) -> "re.Match[bytes] | None":
    """Find a match after a random offset, or else from the start."""
    return pattern.search(data, source.randint(0, len(data))) or pattern.search(data)


def _replace_word(data: bytes, pool: Pool, source: Random) -> bytes:
    match = _find(_WORD, data, source)
    return data if match is None else data[: match.start()] + source.choice(pool.words) + data[match.end() :]


def _swap_word(data: bytes, pool: Pool, source: Random) -> bytes:
    """Replace a word by a word of this or another input."""
    match = _find(_WORD, data, source)
    other = _find(_WORD, source.choice((data, source.choice(pool.inputs))), source)
    return data if match is None or other is None else data[: match.start()] + other[0] + data[match.end() :]


def _insert_word(data: bytes, pool: Pool, source: Random) -> bytes:
    start = source.randint(0, len(data))
    return data[:start] + source.choice(pool.words) + data[start:]


def _remove(data: bytes, _: Pool, source: Random) -> bytes:
    start, end = _span(data, source)
    return data[:start] + data[end:]


def _cut(data: bytes, _: Pool, source: Random) -> bytes:
    return data[: source.randint(0, len(data))]


def _repeat(data: bytes, _: Pool, source: Random) -> bytes:
    start, end = _span(data, source)
    return data[:end] + data[start:end] * source.randint(1, _MAX_COPIES) + data[end:]


def _splice(data: bytes, pool: Pool, source: Random) -> bytes:
    """Insert a part of another input."""
    other = source.choice(pool.inputs)
    start, end = _span(data, source)
    from_, to = _span(other, source, max(1, len(other)))
    return data[:start] + other[from_:to] + data[end:]


def _overwrite(data: bytes, _: Pool, source: Random) -> bytes:
    start = source.randint(0, len(data))
    replacement = source.randbytes(source.randint(1, 8))
    return data[:start] + replacement + data[start + len(replacement) :]


def _flip_bit(data: bytes, _: Pool, source: Random) -> bytes:
    if not data:
        return data
    start = source.randrange(len(data))
    return data[:start] + bytes([data[start] ^ 1 << source.randrange(8)]) + data[start + 1 :]


def _write_integer(data: bytes, _: Pool, source: Random) -> bytes:
    size = source.choice((1, 2, 4, 8))
    number = source.choice(_SPECIAL_INTEGERS) % 256**size
    replacement = number.to_bytes(size, source.choice(("little", "big")))
    start = source.randint(0, len(data))
    return data[:start] + replacement + data[start + size :]


def _add_integer(data: bytes, _: Pool, source: Random) -> bytes:
    """Change a number slightly, such as a length or count."""
    size = source.choice((1, 2, 4))
    if len(data) < size:
        return data
    start = source.randint(0, len(data) - size)
    order = source.choice(("little", "big"))
    number = (int.from_bytes(data[start : start + size], order) + source.randint(-9, 9)) % 256**size
    return data[:start] + number.to_bytes(size, order) + data[start + size :]


def _write_float(data: bytes, _: Pool, source: Random) -> bytes:
    replacement = struct.pack(source.choice(("<f", "<d", ">f", ">d")), source.choice(_SPECIAL_FLOATS))
    start = source.randint(0, len(data)) & ~3
    return data[:start] + replacement + data[start + len(replacement) :]


def _rename_tag(data: bytes, pool: Pool, source: Random) -> bytes:
    match = _find(_TAG, data, source)
    other = _find(_TAG, source.choice((data, source.choice(pool.inputs))), source)
    if match is None or other is None:
        return data
    return (
        data[: match.start(1)]
        + other[1]
        + data[match.end(1) :].replace(b"</" + match[1] + b">", b"</" + other[1] + b">", 1)
    )


def _repeat_element(data: bytes, pool: Pool, source: Random) -> bytes:
    """Repeat an element, or insert an element of another input before it."""
    match = _find(_TAG, data, source)
    donor = source.choice((data, source.choice(pool.inputs)))
    other = _find(_TAG, donor, source)
    if match is None or other is None:
        return data
    close = b"</" + other[1] + b">"
    end = donor.find(close, other.end())
    element = donor[other.start() : end + len(close)] if end >= 0 else donor[other.start() :].partition(b">")[0] + b">"
    return data[: match.start()] + element + data[match.start() :]


def _remove_element(data: bytes, _: Pool, source: Random) -> bytes:
    match = _find(_TAG, data, source)
    if match is None:
        return data
    close = b"</" + match[1] + b">"
    end = data.find(close, match.end())
    return data if end < 0 else data[: match.start()] + data[end + len(close) :]


def _edit_json(data: bytes, _: Pool, source: Random) -> bytes:
    """Change a value of a JSON object in the input."""
    start = data.find(b"{", source.randint(0, len(data)))
    try:
        value, length = _DECODER.raw_decode(data[start:].decode("latin-1"))
    except (ValueError, RecursionError):
        return data
    return data[:start] + json.dumps(_changed(value, source)).encode() + data[start + length :]


def _changed(value: Any, source: Random) -> Any:
    """Return a JSON value with one part replaced, removed or repeated."""
    if not value or not isinstance(value, (dict, list)) or source.random() < 0.1:
        return source.choice(_SPECIAL_VALUES)
    if isinstance(value, dict):
        members: dict[str, Any] = dict(value)
        key = source.choice(sorted(members))
        if source.random() < 0.1:
            del members[key]
            return members
        return members | {key: _changed(members[key], source)}
    items: list[Any] = list(value)
    index = source.randrange(len(items))
    if source.random() < 0.2:
        return items[:index] + items[index : index + 1] * source.choice((0, 2, _MAX_COPIES)) + items[index + 1 :]
    items[index] = _changed(items[index], source)
    return items


_EDITS: tuple[Edit, ...] = (
    _replace_word, _replace_word, _swap_word, _insert_word, _remove, _cut, _repeat, _splice, _overwrite, _flip_bit,
    _write_integer, _add_integer, _write_float, _rename_tag, _repeat_element, _remove_element,
    _edit_json, _edit_json,
)  # fmt: skip
