"""Conversion of the xacro package's errors to a sentence and a source position."""

import contextlib
import html
import re
from collections.abc import Iterable
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.files import read_text

from .missing_packages import missing_package

_REPEATED = r"<class '[\w.]+'>: (.*?) \1"
"""Pattern of an error in $(…): the class and the message twice."""
_EXPRESSION = re.compile(r"\s*when evaluating expression '(.*)'\Z", re.DOTALL)
_UNDEFINED = re.compile(r"name '\w+' is not defined\b")
_LONGEST = 400
"""Longest error message: it quotes the expression and all that contain it."""
_LONGEST_NAME = 200
"""Longest file name in a message."""
_MAX_BYTES = 4_000_000
"""Largest file searched for the line of an error."""


def description_error(error: Exception, at: Source, top: Path, files: Iterable[str]) -> DescriptionError:
    """Return the error with its position in a file.

    Args:
        error: raised by the package; may wrap others.
        at: the element that was expanded.
        top: the file that was expanded.
        files: every file read, one of which contains the expression.
    """
    inner: object = error
    expression = None
    what = ""
    missing = missing_package(error)
    names = () if missing is None else (missing.name,)
    while inner is not None:
        if isinstance(inner, DescriptionError):  # refused within an expression
            at, what, names = inner.at, inner.what, inner.missing_packages
        elif isinstance(inner, OSError):
            what = _why_unreadable(inner)
        elif found := _EXPRESSION.match(str(getattr(inner, "suffix", ""))):
            expression = found[1]
        inner = getattr(inner, "exc", None)
    what = what or re.sub(_REPEATED, r"\1", " ".join(str(error).split())) or type(error).__name__
    what = what if len(what) <= _LONGEST else f"{what[:_LONGEST]} …"
    place = None if expression is None else _find_place(f"${{{expression}}}", {at.file, *files})
    place = place or at
    if _UNDEFINED.match(what) and place.file == str(top):
        what = f"{what}; is the file a part to include, not a robot? what includes it defines the name"
    return DescriptionError(place, what, missing_packages=names)


def _why_unreadable(error: OSError) -> str:
    name = str(error.filename)
    name = name if len(name) <= _LONGEST_NAME else f"{name[:_LONGEST_NAME]}…"
    return f"no such file {name!r}" if isinstance(error, FileNotFoundError) else f"{name}: {error.strerror}"


def _find_place(text: str, files: Iterable[str]) -> Source | None:
    """Return the position of a text if it occurs exactly once."""
    places: list[Source] = []
    for name in files:
        with contextlib.suppress(OSError):
            written = html.unescape(read_text(name, max_bytes=_MAX_BYTES))
            places += [Source(name, written.count("\n", 0, found) + 1) for found in _all(text, written)]
    return places[0] if len(places) == 1 else None


def _all(text: str, written: str) -> list[int]:
    first = written.find(text)
    return [] if first < 0 else [first] if written.find(text, first + 1) < 0 else [first, first]
