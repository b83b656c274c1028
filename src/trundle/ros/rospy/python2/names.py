"""Python 2's built-in names, for translated programs."""

import builtins
import importlib
import io
import operator
import string
import sys
import time
import types
from collections.abc import Callable, Iterable
from functools import cache, cmp_to_key, reduce
from typing import Any


@cache
def python2_builtins() -> dict[str, Any]:
    """Names for a module's `__builtins__`: Python 3's, replaced and extended by Python 2's."""
    functions = (apply, cmp, execfile, filter, input, map, ord, reload, round, sorted, unicode, zip, range)
    helpers = (python2_divide, python2_divide_in_place, python2_divisor, python2_string_exception)
    names = {**vars(builtins), **{function.__name__: function for function in (*functions, *helpers)}}
    names.update(
        python2_cmp_to_key=cmp_to_key, basestring=str, long=int, unichr=chr, xrange=builtins.range, reduce=reduce
    )
    names.update(raw_input=builtins.input, file=builtins.open, intern=sys.intern, buffer=memoryview)
    return {**names, "StandardError": Exception}


def add_module_names() -> None:
    """Add names that `sys`, `types`, `string` and `time` have only in Python 2."""
    for module, values in (
        (sys, {"setdefaultencoding": _nothing, "exc_clear": _nothing, "maxint": sys.maxsize}),
        (types, {"StringType": str, "StringTypes": (str,), "UnicodeType": str, "IntType": int, "LongType": int}),
        (types, {"FloatType": float, "BooleanType": bool, "ListType": list, "TupleType": tuple, "DictType": dict}),
        (types, {"NoneType": type(None), "TypeType": type, "FileType": io.IOBase, "ObjectType": object}),
        (time, {"clock": time.process_time}),
        (string, {"letters": string.ascii_letters, "lowercase": string.ascii_lowercase, "join": _join, "atoi": int}),
        (string, {"uppercase": string.ascii_uppercase, "atof": float, "split": str.split, "strip": str.strip}),
        (
            string,
            {"replace": str.replace, "lower": str.lower, "upper": str.upper, "find": str.find},
        ),
    ):
        for name, value in values.items():
            if not hasattr(module, name):
                setattr(module, name, value)


def python2_divide(left: Any, right: Any) -> Any:
    """`/`: floor division of ints and integer arrays, true division of other values."""
    if isinstance(left, int) and isinstance(right, int):
        return left // right
    numpy = sys.modules.get("numpy")
    if numpy is not None and _are_integer_arrays(numpy, left, right):
        return numpy.floor_divide(left, right)
    return left / right


def python2_divide_in_place(left: Any, right: Any) -> Any:
    """`/=`; arrays are divided in place."""
    if not hasattr(left, "dtype"):
        return python2_divide(left, right) if isinstance(left, int) else operator.itruediv(left, right)
    numpy = sys.modules.get("numpy")
    if numpy is not None and _are_integer_arrays(numpy, left, right):
        left //= right
    elif numpy is not None and isinstance(left, numpy.ndarray) and left.dtype.kind in "iub":
        left[...] = left / right  # Python 2's numpy casts the result back
    else:
        left /= right
    return left


class python2_divisor:  # noqa: N801 – names in translated programs are in lower case
    """Divisor of a translated `a /= b`, which divides as in Python 2 while Python evaluates `a` only once."""

    __array_ufunc__ = None

    def __init__(self, value: Any) -> None:
        self._value = value

    def __rtruediv__(self, left: Any) -> Any:
        return python2_divide_in_place(left, self._value)


@cache
def python2_string_exception(text: str) -> type[Exception]:
    """Return the exception class of a Python 2 string exception, `raise "text"`."""
    return type(text.replace("\0", ""), (Exception,), {"__module__": "builtins"})


def _are_integer_arrays(numpy: Any, left: Any, right: Any) -> bool:
    if not any(isinstance(operand, numpy.ndarray | numpy.generic) for operand in (left, right)):
        return False
    return all(numpy.asarray(operand).dtype.kind in "iub" for operand in (left, right))


class _TextClass(type):
    def __instancecheck__(cls, value: object) -> bool:
        return isinstance(value, str)

    def __call__(cls, value: Any = "", encoding: str = "utf-8", errors: str = "strict") -> str:
        return value.decode(encoding, errors) if isinstance(value, bytes) else str(value)


class unicode(metaclass=_TextClass):  # noqa: N801
    """Python 2's `unicode`; the encoding is of bytes and is ignored for a str."""


def apply(function: Callable[..., Any], args: Iterable[Any] = (), kwargs: dict[str, Any] | None = None) -> Any:
    return function(*args, **(kwargs or {}))


def cmp(left: Any, right: Any) -> int:
    return (left > right) - (left < right)


def execfile(path: str, scope: dict[str, Any] | None = None, names: dict[str, Any] | None = None) -> None:
    scope = sys._getframe(1).f_globals if scope is None else scope  # pyright: ignore[reportPrivateUsage]
    with builtins.open(path, encoding="utf-8") as file:
        builtins.exec(compile(file.read(), path, "exec"), scope, scope if names is None else names)


def filter(function: Callable[[Any], Any] | None, values: Iterable[Any]) -> Any:
    matches = list(builtins.filter(function, values))
    if isinstance(values, str):
        return "".join(matches)
    return tuple(matches) if isinstance(values, tuple) else matches


def input(prompt: str = "") -> Any:
    frame = sys._getframe(1)  # pyright: ignore[reportPrivateUsage]
    return eval(builtins.input(prompt), frame.f_globals, dict(frame.f_locals))


def map(function: Callable[..., Any] | None, *lists: Iterable[Any]) -> list[Any]:
    if function is None:
        return list(lists[0]) if len(lists) == 1 else zip(*lists)
    return list(builtins.map(function, *lists))


def ord(letter: Any) -> int:
    """`ord` of a character; the value of a byte, which is an int."""
    return letter if isinstance(letter, int) else builtins.ord(letter)


def range(*limits: Any) -> list[int]:
    return list(builtins.range(*(int(limit) for limit in limits)))


def reload(module: Any) -> Any:
    return module if module is sys else importlib.reload(module)


def round(number: Any, digits: int = 0) -> Any:
    """Half away from zero, as a float."""
    scale = 10.0**digits
    scaled = abs(float(number)) * scale
    whole = float(int(scaled + 0.5)) if scaled < 1e15 else scaled
    return (whole / scale) * (-1.0 if number < 0 else 1.0)


def sorted(values: Iterable[Any], cmp: Any = None, key: Any = None, reverse: bool = False) -> list[Any]:
    if cmp is None:
        return builtins.sorted(values, key=key, reverse=reverse)
    by = cmp_to_key(cmp)
    return builtins.sorted(values, key=by if key is None else lambda value: by(key(value)), reverse=reverse)


def zip(*lists: Iterable[Any]) -> list[Any]:
    return list(builtins.zip(*lists, strict=False))


def _join(words: Iterable[str], separator: str = " ") -> str:
    return separator.join(words)


def _nothing(*_: object) -> None:
    """Do nothing, in place of a function without a counterpart in Python 3."""
