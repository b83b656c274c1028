"""Damages inputs: bytes, numbers, words, elements; the format's words and parts of other inputs are put in."""

import json
import re
import struct
from collections.abc import Callable, Sequence
from random import Random
from typing import Any

_ODD_WORDS = (
    b"", b"0", b"-1", b"1e400", b"nan", b"inf", b"-inf", b"3e38", b"1e308", b"1e-320", b"2147483648",
    b"-9223372036854775809", b"999999999999", b"true", b"/", b"//", b"~", b"..", b"../../x", b"\0", b"\xff\xfe",
    b"\xef\xbb\xbf", b"\xed\xa0\x80", b"\xc3\xa9", b"&#27;", b"&amp;", b"&x;", b"<", b"]]>", b"<!--", b'"', b"{",
    b"[", b"${", b"$(", b"$(find x)", b"${1/0}", b"model://m", b"package://p/x", b"file:///", b"!!python/name:os",
    b"*a", b"&a [*a, *a]", b"x" * 5000, b"[" * 500, b"\n", b"\r\n", b"1 2 3 4 5 6 7 8", b"::",
)  # fmt: skip
_ODD_INTEGERS = (0, 1, -1, 2, 3, 7, 127, 128, 255, 256, 32767, 65535, 65536, 2**24, 2**31 - 1, 2**31, 2**32 - 1, 2**63)
_ODD_FLOATS = (0.0, -0.0, 1.0, -1.0, 1e-45, 1e38, 3.4e38, float("inf"), float("-inf"), float("nan"))
_ODD_VALUES: tuple[Any, ...] = (
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
        """Keep words of the format, and inputs, which may not be none."""
        self.words = (*words, *_ODD_WORDS)
        self.inputs = inputs


def mutate(data: bytes, pool: Pool, source: Random) -> bytes:
    """Return an input with one to four edits."""
    for _ in range(source.randint(1, _MAX_EDITS)):
        data = source.choice(_EDITS)(data, pool, source)
    return data


def _span(data: bytes, source: Random, most: int = _MAX_SPAN) -> tuple[int, int]:
    start = source.randint(0, len(data))
    return start, min(len(data), start + source.randint(0, source.choice((1, 4, 16, most))))


def _find(pattern: "re.Pattern[bytes]", data: bytes, source: Random) -> "re.Match[bytes] | None":
    """Find a match after a random place, or else from the start."""
    return pattern.search(data, source.randint(0, len(data))) or pattern.search(data)


def _replace_word(data: bytes, pool: Pool, source: Random) -> bytes:
    found = _find(_WORD, data, source)
    return data if found is None else data[: found.start()] + source.choice(pool.words) + data[found.end() :]


def _swap_word(data: bytes, pool: Pool, source: Random) -> bytes:
    """Put a word of this or another input in place of one."""
    found = _find(_WORD, data, source)
    other = _find(_WORD, source.choice((data, source.choice(pool.inputs))), source)
    return data if found is None or other is None else data[: found.start()] + other[0] + data[found.end() :]


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
    """Put a part of another input in."""
    other = source.choice(pool.inputs)
    start, end = _span(data, source)
    from_, to = _span(other, source, max(1, len(other)))
    return data[:start] + other[from_:to] + data[end:]


def _overwrite(data: bytes, _: Pool, source: Random) -> bytes:
    start = source.randint(0, len(data))
    odd = source.randbytes(source.randint(1, 8))
    return data[:start] + odd + data[start + len(odd) :]


def _flip_bit(data: bytes, _: Pool, source: Random) -> bytes:
    if not data:
        return data
    start = source.randrange(len(data))
    return data[:start] + bytes([data[start] ^ 1 << source.randrange(8)]) + data[start + 1 :]


def _write_integer(data: bytes, _: Pool, source: Random) -> bytes:
    size = source.choice((1, 2, 4, 8))
    number = source.choice(_ODD_INTEGERS) % 256**size
    odd = number.to_bytes(size, source.choice(("little", "big")))
    start = source.randint(0, len(data))
    return data[:start] + odd + data[start + size :]


def _add_integer(data: bytes, _: Pool, source: Random) -> bytes:
    """Change a number a little: lengths and counts that are nearly right."""
    size = source.choice((1, 2, 4))
    if len(data) < size:
        return data
    start = source.randint(0, len(data) - size)
    order = source.choice(("little", "big"))
    number = (int.from_bytes(data[start : start + size], order) + source.randint(-9, 9)) % 256**size
    return data[:start] + number.to_bytes(size, order) + data[start + size :]


def _write_float(data: bytes, _: Pool, source: Random) -> bytes:
    odd = struct.pack(source.choice(("<f", "<d", ">f", ">d")), source.choice(_ODD_FLOATS))
    start = source.randint(0, len(data)) & ~3
    return data[:start] + odd + data[start + len(odd) :]


def _rename_tag(data: bytes, pool: Pool, source: Random) -> bytes:
    found = _find(_TAG, data, source)
    other = _find(_TAG, source.choice((data, source.choice(pool.inputs))), source)
    if found is None or other is None:
        return data
    return (
        data[: found.start(1)]
        + other[1]
        + data[found.end(1) :].replace(b"</" + found[1] + b">", b"</" + other[1] + b">", 1)
    )


def _repeat_element(data: bytes, pool: Pool, source: Random) -> bytes:
    """Double an element, or put one of another input beside it."""
    found = _find(_TAG, data, source)
    giving = source.choice((data, source.choice(pool.inputs)))
    other = _find(_TAG, giving, source)
    if found is None or other is None:
        return data
    close = b"</" + other[1] + b">"
    end = giving.find(close, other.end())
    element = (
        giving[other.start() : end + len(close)] if end >= 0 else giving[other.start() :].partition(b">")[0] + b">"
    )
    return data[: found.start()] + element + data[found.start() :]


def _remove_element(data: bytes, _: Pool, source: Random) -> bytes:
    found = _find(_TAG, data, source)
    if found is None:
        return data
    close = b"</" + found[1] + b">"
    end = data.find(close, found.end())
    return data if end < 0 else data[: found.start()] + data[end + len(close) :]


def _edit_json(data: bytes, _: Pool, source: Random) -> bytes:
    """Change a value of a JSON object inside."""
    start = data.find(b"{", source.randint(0, len(data)))
    try:
        value, length = _DECODER.raw_decode(data[start:].decode("latin-1"))
    except (ValueError, RecursionError):
        return data
    return data[:start] + json.dumps(_changed(value, source)).encode() + data[start + length :]


def _changed(value: Any, source: Random) -> Any:
    """Return a JSON value with one part replaced, removed or repeated."""
    if not value or not isinstance(value, (dict, list)) or source.random() < 0.1:
        return source.choice(_ODD_VALUES)
    if isinstance(value, dict):
        members: dict[str, Any] = dict(value)
        key = source.choice(sorted(members))
        if source.random() < 0.1:
            del members[key]
            return members
        return members | {key: _changed(members[key], source)}
    items: list[Any] = list(value)
    place = source.randrange(len(items))
    if source.random() < 0.2:
        return items[:place] + items[place : place + 1] * source.choice((0, 2, _MAX_COPIES)) + items[place + 1 :]
    items[place] = _changed(items[place], source)
    return items


_EDITS: tuple[Edit, ...] = (
    _replace_word, _replace_word, _swap_word, _insert_word, _remove, _cut, _repeat, _splice, _overwrite, _flip_bit,
    _write_integer, _add_integer, _write_float, _rename_tag, _repeat_element, _remove_element,
    _edit_json, _edit_json,
)  # fmt: skip
