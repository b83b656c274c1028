"""Words an error of the xacro package as ours: what is wrong, and where."""

import contextlib
import html
import re
from collections.abc import Iterable

from trundle.diagnostics import DescriptionError, Source
from trundle.files import read_text

_REPEATED = r"<class '[\w.]+'>: (.*?) \1"
"""How the package words an error of $(…): its class, then what it says, twice."""
_EXPRESSION = re.compile(r"\s*when evaluating expression '(.*)'\Z", re.DOTALL)
_LONGEST = 400
"""Characters of an error: it quotes the expression, and each that this one was part of."""
_LONGEST_NAME = 200
"""Characters of a file's."""
_MAX_BYTES = 4_000_000
"""Size of the largest file that is searched for the line."""


def description_error(error: Exception, at: Source, files: Iterable[str]) -> DescriptionError:
    """Find what a file did wrong.

    Args:
        error: what the package raised; others may stand within it.
        at: the element that was expanded.
        files: every file that was read, one of which holds the expression.
    """
    inner: object = error
    expression = None
    what = ""
    while inner is not None:
        if isinstance(inner, DescriptionError):  # what was refused amid an expression
            at, what = inner.at, inner.what
        elif isinstance(inner, OSError):
            what = _why_unreadable(inner)
        elif found := _EXPRESSION.match(str(getattr(inner, "suffix", ""))):
            expression = found[1]
        inner = getattr(inner, "exc", None)
    what = what or re.sub(_REPEATED, r"\1", " ".join(str(error).split())) or type(error).__name__
    what = what if len(what) <= _LONGEST else f"{what[:_LONGEST]} …"
    place = None if expression is None else _find_place(f"${{{expression}}}", {at.file, *files})
    return DescriptionError(place or at, what)


def _why_unreadable(error: OSError) -> str:
    name = str(error.filename)
    name = name if len(name) <= _LONGEST_NAME else f"{name[:_LONGEST_NAME]}…"
    return f"no such file {name!r}" if isinstance(error, FileNotFoundError) else f"{name}: {error.strerror}"


def _find_place(text: str, files: Iterable[str]) -> Source | None:
    """The one place that holds a text; where there are several, none."""
    places: list[Source] = []
    for name in files:
        with contextlib.suppress(OSError):
            written = html.unescape(read_text(name, max_bytes=_MAX_BYTES))
            places += [Source(name, written.count("\n", 0, found) + 1) for found in _all(text, written)]
    return places[0] if len(places) == 1 else None


def _all(text: str, written: str) -> list[int]:
    first = written.find(text)
    return [] if first < 0 else [first] if written.find(text, first + 1) < 0 else [first, first]
