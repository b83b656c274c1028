"""What was found while reading, and where: sources, warnings and the error that ends a reading.

A `Diagnostics` is passed in by whoever asked for the reading; there is no global log. Every command imports this, so
nothing here is a dataclass: their module takes longer to load than light commands take to work.

    TrundleError
    ├── DescriptionError   a file says something nothing sensible can be made of
    └── UsageError         the request itself is off (a taken port, an unknown name)
"""

from collections.abc import Iterable
from typing import Literal, NamedTuple, TypeAlias, TypedDict

Severity: TypeAlias = Literal["error", "warning", "info"]
_NAMED = 3
"""Lines that are named beside the first where many are meant."""
_ORDER: dict[str, int] = {"error": 0, "warning": 1, "info": 2}


class Source(NamedTuple):
    """A place in a text: the file as the user named it and the line, counted from 1."""

    file: str
    line: int | None = None

    def __str__(self) -> str:
        return self.file if self.line is None else f"{self.file}:{self.line}"


class TrundleError(Exception):
    """Everything Trundle raises for a reason a user can mend."""


class UsageError(TrundleError):
    """The request cannot be met as it was put."""


class DescriptionError(TrundleError):
    """A file, or a place in it, of which nothing sensible can be made."""

    def __init__(self, at: Source, what: str, *, more: "Iterable[DescriptionError]" = ()) -> None:
        """Say what is wrong, and `more` that is."""
        self.at = at
        self.what = what
        self.more = tuple(more)
        super().__init__("\n".join([f"{at}: error: {what}", *map(str, self.more)]))


class DiagnosticJson(TypedDict):
    """One finding as `--json` prints it."""

    severity: str
    file: str
    line: int | None
    message: str


class Diagnostic(NamedTuple):
    """One finding."""

    severity: Severity
    at: Source
    what: str

    def __str__(self) -> str:
        return f"{self.at}: {self.severity}: {self.what}"

    def as_json(self) -> DiagnosticJson:
        return {"severity": self.severity, "file": self.at.file, "line": self.at.line, "message": self.what}


class Diagnostics:
    """Collects findings in the order they were made, each once."""

    def __init__(self, *, strict: bool = False) -> None:
        """Start with nothing found; `strict` makes every warning an error, and the reading ends at the first one."""
        self.strict = strict
        self.findings: list[Diagnostic] = []
        self._seen: set[Diagnostic] = set()

    def warn(self, at: Source, what: str) -> None:
        """Name something wrong or unsupported; the sentence states what is done instead.

        Raises:
            DescriptionError: in strict mode.
        """
        if self.strict:
            raise DescriptionError(at, what)
        self._add(Diagnostic("warning", at, what))

    def warn_error(self, error: TrundleError, at: Source, otherwise: str, *, who: str = "") -> None:
        """Name an error that ends nothing, where it says itself or else at `at`; `otherwise` states what is done.

        Raises:
            DescriptionError: in strict mode.
        """
        where, what = (error.at, error.what) if isinstance(error, DescriptionError) else (at, str(error))
        self.warn(where, f"{who}: {what}; {otherwise}" if who else f"{what}; {otherwise}")

    def info(self, at: Source, what: str) -> None:
        """Name a rule that fired and that a reader of the file may not expect."""
        self._add(Diagnostic("info", at, what))

    def error(self, error: DescriptionError) -> None:
        """Keep the error that ended a reading, and more that it names, beside what led up to it."""
        for each in (error, *error.more):
            self._add(Diagnostic("error", each.at, each.what))

    def extend(self, findings: Iterable[Diagnostic]) -> None:
        """Take over another collection's findings."""
        for finding in findings:
            self._add(finding)

    def _add(self, finding: Diagnostic) -> None:
        if finding not in self._seen:
            self._seen.add(finding)
            self.findings.append(finding)

    @property
    def warnings(self) -> list[str]:
        """The warnings as printed."""
        return [str(f) for f in self.findings if f.severity == "warning"]

    @property
    def errors(self) -> list[str]:
        """The errors as printed."""
        return [str(f) for f in self.findings if f.severity == "error"]

    def worst_first(self) -> list[str]:
        """Errors, then warnings, then notes as printed; what is said of many lines of a file is printed once."""
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
