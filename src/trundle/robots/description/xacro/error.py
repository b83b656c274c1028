"""Conversion of the xacro package's errors to a message with a source position."""

import contextlib
import html
import re
from collections.abc import Iterable
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.files import read_text

from .missing_packages import missing_package

_REPEATED = r"<class '[\w.]+'>: (.*?) \1"
"""Pattern of an error in $(…), which repeats the message after the class."""
_EXPRESSION = re.compile(r"\s*when evaluating expression '(.*)'\Z", re.DOTALL)
_UNDEFINED = re.compile(r"name '\w+' is not defined\b")
_MAX_MESSAGE = 400
"""Maximum length of a message, which quotes the expression and all that contain it."""
_MAX_NAME = 200
"""Maximum length of a file name in a message."""
_MAX_BYTES = 4_000_000
"""Maximum size of a file searched for the line of an error."""


def description_error(error: Exception, at: Source, top: Path, files: Iterable[str]) -> DescriptionError:
    """Return the error with its position in a file.

    Args:
        error: exception of the package; may wrap others.
        at: position of the element being expanded.
        top: file to expand.
        files: every file read; one of them contains the expression.
    """
    inner: object = error
    expression = None
    message = ""
    missing = missing_package(error)
    names = () if missing is None else (missing.name,)
    id = "xacro" if missing is None else "missing-package"
    while inner is not None:
        if isinstance(inner, DescriptionError):  # refused within an expression
            at, message, names, id = inner.at, inner.what, inner.missing_packages, inner.id
        elif isinstance(inner, OSError):
            message = _why_unreadable(inner)
            id = "missing-file" if isinstance(inner, FileNotFoundError) else "unreadable-file"
        elif match := _EXPRESSION.match(str(getattr(inner, "suffix", ""))):
            expression = match[1]
        inner = getattr(inner, "exc", None)
    message = message or re.sub(_REPEATED, r"\1", " ".join(str(error).split())) or type(error).__name__
    message = message if len(message) <= _MAX_MESSAGE else f"{message[:_MAX_MESSAGE]} …"
    source = None if expression is None else _find_text(f"${{{expression}}}", {at.file, *files})
    source = source or at
    if _UNDEFINED.match(message) and source.file == str(top):
        message = f"{message}; is the file a part to include, not a robot? what includes it defines the name"
    return DescriptionError(source, message, id, missing_packages=names)


def _why_unreadable(error: OSError) -> str:
    name = str(error.filename)
    name = name if len(name) <= _MAX_NAME else f"{name[:_MAX_NAME]}…"
    return f"no such file {name!r}" if isinstance(error, FileNotFoundError) else f"{name}: {error.strerror}"


def _find_text(text: str, files: Iterable[str]) -> Source | None:
    """Return the position of a text if it occurs exactly once."""
    sources: list[Source] = []
    for name in files:
        with contextlib.suppress(OSError):
            content = html.unescape(read_text(name, max_bytes=_MAX_BYTES))
            sources += [Source(name, content.count("\n", 0, index) + 1) for index in _all(text, content)]
    return sources[0] if len(sources) == 1 else None


def _all(text: str, content: str) -> list[int]:
    first = content.find(text)
    return [] if first < 0 else [first] if content.find(text, first + 1) < 0 else [first, first]
