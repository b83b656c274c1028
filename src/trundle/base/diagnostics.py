"""Warnings and errors of reading files, with their source positions.

A `Diagnostics` is passed in by the caller; there is no global log. Every command imports this module, so it has no
dataclasses: their module takes longer to load than light commands take to run. A finding has the ID of an entry in
`trundle.base.explanations`, which `trundle explain ID` prints.

    TrundleError
    ├── DescriptionError           a file cannot be interpreted
    │   └── UnknownArgumentError   an argument that a file does not declare
    └── UsageError                an invalid request (a port in use, an unknown name)

    TrundleWarning                 what `trundle.load` cannot simulate of a file
"""

import os
from collections.abc import Collection, Iterable
from typing import Literal, NamedTuple, TextIO, TypeAlias, TypedDict

Severity: TypeAlias = Literal["error", "warning", "info"]
_CONTROLS = (*range(0x20), *range(0x7F, 0xA0), 0x2028, 0x2029, *range(0x202A, 0x202F), *range(0x2066, 0x206A))
"""Line breaks, terminal control characters, and marks that reorder displayed text."""
_ESCAPES = {code: repr(chr(code))[1:-1] for code in _CONTROLS}
_COLORS = {"error": 31, "warning": 33, "info": 36}
"""ANSI's red, yellow and cyan."""
_TYPO_SIMILARITY = 0.75
"""Minimum similarity of a name with one or two typing errors."""
_MAX_LISTED = 3
"""Maximum number of further lines listed for one message."""
_ORDER: dict[str, int] = {"error": 0, "warning": 1, "info": 2}


def printable(text: str) -> str:
    """Return a text on one line, with control characters escaped as in Python."""
    return text.translate(_ESCAPES)


def colored(text: str, stream: TextIO) -> str:
    """Color the severity in each line of findings, if the stream is a terminal and NO_COLOR is not set."""
    if not stream.isatty() or os.environ.get("NO_COLOR"):  # https://no-color.org
        return text
    return "\n".join(map(_colored_line, text.split("\n")))


def _colored_line(line: str) -> str:
    for severity, color in _COLORS.items():
        at, marker, what = line.partition(f" {severity}: ")
        if marker and (at.endswith(":") or not at):
            return f"{at} \033[1;{color}m{severity}:\033[0m {what}"
    return line


class Source(NamedTuple):
    """Source position: the file as named by the user, and the line, counted from 1."""

    __module__ = "trundle"

    file: str
    """Name of the file as the user gave it."""
    line: int | None = None
    """Line, counted from 1; None: the whole file."""

    def __str__(self) -> str:
        file = printable(self.file)
        return file if self.line is None else f"{file}:{self.line}"


class TrundleError(Exception):
    """Base of all errors that a user can fix."""

    __module__ = "trundle"

    id: str = ""
    """ID that `trundle explain` explains; empty: it has none."""
    missing_packages: tuple[str, ...] = ()
    """Names of missing ROS packages."""


class TrundleWarning(UserWarning):
    """Part of a file that is not simulated as written; Python prints it with file and line."""

    __module__ = "trundle"


class UsageError(TrundleError):
    """Request that cannot be fulfilled."""

    __module__ = "trundle"

    def __init__(self, what: str, *, id: str = "", missing_packages: tuple[str, ...] = ()) -> None:
        """State the error."""
        self.id = id or self.id
        self.missing_packages = missing_packages
        super().__init__(what)


class DescriptionError(TrundleError):
    """File, or part of a file, that cannot be interpreted."""

    __module__ = "trundle"

    def __init__(
        self,
        at: Source,
        what: str,
        id: str = "",
        *,
        more: "Iterable[DescriptionError]" = (),
        missing_packages: tuple[str, ...] = (),
    ) -> None:
        """State the error, and further ones in `more`."""
        self.id = id or self.id
        self.missing_packages = missing_packages
        self.at = at
        self.what = what = printable(what)
        self.more = tuple(more)
        super().__init__("\n".join([str(Diagnostic("error", at, what, self.id)), *map(str, self.more)]))


class UnknownArgumentError(DescriptionError):
    """Argument that a xacro or launch file does not declare."""

    def __init__(self, at: Source, what: str, id: str, *, name: str) -> None:
        """State the error; `name` is the argument's name."""
        super().__init__(at, what, id)
        self.name = name


def nearest(name: str, names: Collection[str], *, similarity: float = 0.6) -> str | None:
    """Return the most similar name; None if none reaches the similarity (0 to 1)."""
    from difflib import get_close_matches  # lazy: slow to import, rarely needed

    return next(iter(get_close_matches(name, sorted(names), n=1, cutoff=similarity)), None)


def did_you_mean(name: str, names: Collection[str]) -> str:
    """Return ` (did you mean 'NAME'?)` for the most similar name; "" if none is similar."""
    near = nearest(name, names, similarity=_TYPO_SIMILARITY)
    return "" if near is None else f" (did you mean {near!r}?)"


def no_such(problem: str, name: object, names: Collection[str]) -> str:
    """Return the sentence for a name that does not exist: `PROBLEM 'NAME' (did you mean …?); there are: …`."""
    near = did_you_mean(name, {*names, *(full.rpartition("::")[2] for full in names)}) if isinstance(name, str) else ""
    return f"{problem} {name!r}{near}; there are: {', '.join(map(repr, names)) or 'none'}"


def similar_file(path: str) -> str:
    """Return ` (did you mean 'NAME'?)` for a missing file's neighbor; "" if none has a similar name."""
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
    id: str


class Diagnostic(NamedTuple):
    """Finding with severity, source and message."""

    __module__ = "trundle"

    severity: Severity
    """error, warning or info."""
    at: Source
    """Position in the file."""
    what: str
    """Sentence that says what is wrong, and what is used instead."""
    id: str = ""
    """ID that `trundle explain` explains; empty: it has none."""

    def __str__(self) -> str:
        return f"{self.sentence()} [{self.id}]" if self.id else self.sentence()

    def sentence(self) -> str:
        """Return the finding on one line, without its ID."""
        return f"{self.at}: {self.severity}: {self.what}"

    def as_json(self) -> DiagnosticJson:
        return {
            "severity": self.severity,
            "file": self.at.file,
            "line": self.at.line,
            "message": self.what,
            "id": self.id,
        }


class Diagnostics:
    """Collection of findings in order, without duplicates."""

    __module__ = "trundle"

    def __init__(self, *, strict: bool = False) -> None:
        """Start empty; `strict` turns every warning into an error, which ends reading."""
        self.strict = strict
        self.findings: list[Diagnostic] = []
        self._seen: set[Diagnostic] = set()

    def warn(self, at: Source, what: str, id: str = "") -> None:
        """Add a warning; its sentence states the fallback.

        Raises:
            DescriptionError: in strict mode.
        """
        if self.strict:
            raise DescriptionError(at, what, id)
        self._add(Diagnostic("warning", at, what, id))

    def warn_error(self, error: TrundleError, at: Source, otherwise: str, id: str, *, subject: str = "") -> None:
        """Add a recovered error as a warning.

        Args:
            error: recovered error.
            at: position for an error without a source of its own.
            otherwise: fallback, as a clause.
            id: ID for an error without one of its own.
            subject: begins the sentence; empty: none.

        Raises:
            DescriptionError: in strict mode.
        """
        where, what = (error.at, error.what) if isinstance(error, DescriptionError) else (at, str(error))
        self.warn(where, f"{subject}: {what}; {otherwise}" if subject else f"{what}; {otherwise}", error.id or id)

    def info(self, at: Source, what: str, id: str = "") -> None:
        """Add a note on an applied rule that may surprise the file's author."""
        self._add(Diagnostic("info", at, what, id))

    def error(self, error: DescriptionError) -> None:
        """Add the error that ended reading, with the further errors in it."""
        for part in (error, *error.more):
            self._add(Diagnostic("error", part.at, part.what, part.id))

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
        """Warnings, a sentence each; `findings` has their IDs."""
        return [f.sentence() for f in self.findings if f.severity == "warning"]

    @property
    def errors(self) -> list[str]:
        """Errors, a sentence each; `findings` has their IDs."""
        return [f.sentence() for f in self.findings if f.severity == "error"]

    def printed_warnings(self) -> list[str]:
        """Return the warnings as printed, with their IDs."""
        return [str(finding) for finding in self.findings if finding.severity == "warning"]

    def worst_first(self) -> list[str]:
        """Return errors, then warnings, then notes as printed; a message on many lines of a file occurs once."""
        lines: dict[Diagnostic, list[int | None]] = {}
        for finding in sorted(self.findings, key=lambda f: _ORDER[f.severity]):
            without_line = finding._replace(at=Source(finding.at.file))
            lines.setdefault(without_line, []).append(finding.at.line)
        return [
            f"{finding._replace(at=Source(finding.at.file, first))}{_also([line for line in more if line])}"
            for finding, (first, *more) in lines.items()
        ]


def _also(lines: list[int]) -> str:
    if not lines:
        return ""
    listed, rest = ", ".join(map(str, lines[:_MAX_LISTED])), len(lines) - _MAX_LISTED
    return f" (also on line{'s' if lines[1:] else ''} {listed}{f' and {rest} more' if rest > 0 else ''})"
