"""Sources, warnings and errors of reading files.

A `Diagnostics` is passed in by the caller; there is no global log. Every command imports this module, so it has no
dataclasses: their module takes longer to load than light commands take to run.

    TrundleError
    ├── DescriptionError           a file cannot be interpreted
    │   └── UnknownArgumentError   a file is given an argument that it does not have
    └── UsageError                the request itself is wrong (a taken port, an unknown name)
"""

import os
from collections.abc import Collection, Iterable
from typing import Literal, NamedTuple, TextIO, TypeAlias, TypedDict

Severity: TypeAlias = Literal["error", "warning", "info"]
_CONTROLS = (*range(0x20), *range(0x7F, 0xA0), 0x2028, 0x2029, *range(0x202A, 0x202F), *range(0x2066, 0x206A))
"""Line breaks, terminals' commands, and marks that change the order in which text is shown."""
_ESCAPES = {code: repr(chr(code))[1:-1] for code in _CONTROLS}
_COLOURS = {"error": 31, "warning": 33, "info": 36}
"""ANSI's red, yellow and cyan."""
_SLIP = 0.75
"""Similarity of a name with a slip of the finger or two."""
_NAMED = 3
"""Most further lines listed for one message."""
_ORDER: dict[str, int] = {"error": 0, "warning": 1, "info": 2}


def printable(text: str) -> str:
    """Return a text on one line, control characters as Python writes them; names out of files may have any."""
    return text.translate(_ESCAPES)


def coloured(text: str, stream: TextIO) -> str:
    """Colour the severity in each line of findings, if the stream is a terminal and NO_COLOR is not set."""
    if not stream.isatty() or os.environ.get("NO_COLOR"):  # https://no-color.org
        return text
    return "\n".join(map(_coloured_line, text.split("\n")))


def _coloured_line(line: str) -> str:
    for severity, colour in _COLOURS.items():
        at, marker, what = line.partition(f" {severity}: ")
        if marker and (at.endswith(":") or not at):
            return f"{at} \033[1;{colour}m{severity}:\033[0m {what}"
    return line


class Source(NamedTuple):
    """Position in a text: the file as named by the user, and the line, counted from 1."""

    file: str
    line: int | None = None

    def __str__(self) -> str:
        file = printable(self.file)
        return file if self.line is None else f"{file}:{self.line}"


class TrundleError(Exception):
    """Base of all errors that a user can fix."""

    missing_packages: tuple[str, ...] = ()
    """ROS packages that would have to be here."""


class UsageError(TrundleError):
    """Request that cannot be fulfilled."""

    def __init__(self, what: str, *, missing_packages: tuple[str, ...] = ()) -> None:
        """State the error."""
        self.missing_packages = missing_packages
        super().__init__(what)


class DescriptionError(TrundleError):
    """File, or place in a file, that cannot be interpreted."""

    def __init__(
        self, at: Source, what: str, *, more: "Iterable[DescriptionError]" = (), missing_packages: tuple[str, ...] = ()
    ) -> None:
        """State the error, and further ones in `more`."""
        self.missing_packages = missing_packages
        self.at = at
        self.what = what = printable(what)
        self.more = tuple(more)
        super().__init__("\n".join([f"{at}: error: {what}", *map(str, self.more)]))


class UnknownArgumentError(DescriptionError):
    """Argument that a xacro or launch file does not have."""

    def __init__(self, at: Source, what: str, *, name: str) -> None:
        """State the error; `name` is the argument's."""
        super().__init__(at, what)
        self.name = name


def nearest(name: str, names: Collection[str], *, similarity: float = 0.6) -> str | None:
    """Return the most similar of some names; None if none is similar, on a scale from 0 to 1."""
    from difflib import get_close_matches  # lazy: slow to import, rarely needed

    return next(iter(get_close_matches(name, sorted(names), n=1, cutoff=similarity)), None)


def did_you_mean(name: str, names: Collection[str]) -> str:
    """Return ` (did you mean 'NAME'?)` for the most similar of some names; "" if none is similar."""
    near = nearest(name, names, similarity=_SLIP)
    return "" if near is None else f" (did you mean {near!r}?)"


def similar_file(path: str) -> str:
    """Return ` (did you mean 'NAME'?)` for a file beside a missing one; "" if none has a similar name."""
    try:
        names = os.listdir(os.path.dirname(path) or ".")
    except (OSError, ValueError):
        return ""
    return did_you_mean(os.path.basename(path), names)


class DiagnosticJson(TypedDict):
    """Finding in `--json` output."""

    severity: str
    file: str
    line: int | None
    message: str


class Diagnostic(NamedTuple):
    """Finding with severity, source and message."""

    severity: Severity
    at: Source
    what: str

    def __str__(self) -> str:
        return f"{self.at}: {self.severity}: {self.what}"

    def as_json(self) -> DiagnosticJson:
        return {"severity": self.severity, "file": self.at.file, "line": self.at.line, "message": self.what}


class Diagnostics:
    """Collection of findings in order, without duplicates."""

    def __init__(self, *, strict: bool = False) -> None:
        """Start empty; `strict` turns every warning into an error, so that reading ends at the first one."""
        self.strict = strict
        self.findings: list[Diagnostic] = []
        self._seen: set[Diagnostic] = set()

    def warn(self, at: Source, what: str) -> None:
        """Add a warning; the sentence states what is done instead.

        Raises:
            DescriptionError: in strict mode.
        """
        if self.strict:
            raise DescriptionError(at, what)
        self._add(Diagnostic("warning", at, what))

    def warn_error(self, error: TrundleError, at: Source, otherwise: str, *, who: str = "") -> None:
        """Add a recovered error as a warning, at its own source or else at `at`; `otherwise` states what is done.

        Raises:
            DescriptionError: in strict mode.
        """
        where, what = (error.at, error.what) if isinstance(error, DescriptionError) else (at, str(error))
        self.warn(where, f"{who}: {what}; {otherwise}" if who else f"{what}; {otherwise}")

    def info(self, at: Source, what: str) -> None:
        """Add a note on an applied rule that a reader of the file may not expect."""
        self._add(Diagnostic("info", at, what))

    def error(self, error: DescriptionError) -> None:
        """Add the error that ended a reading, and the further ones in it."""
        for each in (error, *error.more):
            self._add(Diagnostic("error", each.at, each.what))

    def extend(self, findings: Iterable[Diagnostic]) -> None:
        """Add the findings of another collection."""
        for finding in findings:
            self._add(finding)

    def _add(self, finding: Diagnostic) -> None:
        finding = finding._replace(what=printable(finding.what))
        if finding not in self._seen:
            self._seen.add(finding)
            self.findings.append(finding)

    @property
    def warnings(self) -> list[str]:
        """Printed warnings."""
        return [str(f) for f in self.findings if f.severity == "warning"]

    @property
    def errors(self) -> list[str]:
        """Printed errors."""
        return [str(f) for f in self.findings if f.severity == "error"]

    def worst_first(self) -> list[str]:
        """Return printed errors, then warnings, then notes; a message for many lines of a file is printed once."""
        lines: dict[Diagnostic, list[int | None]] = {}
        for finding in sorted(self.findings, key=lambda f: _ORDER[f.severity]):
            everywhere = finding._replace(at=Source(finding.at.file))
            lines.setdefault(everywhere, []).append(finding.at.line)
        return [
            f"{said._replace(at=Source(said.at.file, first))}{_also([line for line in more if line])}"
            for said, (first, *more) in lines.items()
        ]


def _also(lines: list[int]) -> str:
    if not lines:
        return ""
    named, rest = ", ".join(map(str, lines[:_NAMED])), len(lines) - _NAMED
    return f" (also on line{'s' if lines[1:] else ''} {named}{f' and {rest} more' if rest > 0 else ''})"
