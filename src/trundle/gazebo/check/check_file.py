"""`trundle check`: the contents of a file, and what is doubtful about them; nothing in it is run."""

import os
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.base.files import open_file
from trundle.robots.load_input import Piped, read_piped
from trundle.robots.packages import Packages

if TYPE_CHECKING:
    from trundle.base.drawing.tree import TreeNode

_LAUNCH = (".launch", ".launch.py", ".launch.xml", ".test")
_LAUNCH_TAG = re.compile(rb"(?:\xef\xbb\xbf)?(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>]*>)*+<launch[\s/>]", re.DOTALL)
"""Start of an XML document, up to its root element."""
_START_BYTES = 64 * 1024


class Findings(Protocol):
    """Contents of a checked file."""

    def as_json(self) -> dict[str, object]:
        """Contents, as `check --json` prints them."""
        ...

    def sentence(self) -> str:
        """Kind and counts, on one line."""
        ...

    def trees(self) -> "list[TreeNode]":
        """Kinematic trees of the file."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckResult:
    """Contents and findings of one file."""

    file: str
    findings: Findings | None
    """None: the file was refused."""
    report: Diagnostics

    def trees(self) -> "list[TreeNode]":
        """Kinematic trees; none if the file was refused."""
        return [] if self.findings is None else self.findings.trees()

    @property
    def is_refused(self) -> bool:
        """True if the file could not be read."""
        return self.findings is None

    def as_json(self) -> dict[str, object]:
        """Resolved description and every finding."""
        findings = [finding.as_json() for finding in self.report.findings]
        understood: dict[str, object] = {"kind": None, "models": []}
        if self.findings is not None:
            understood = self.findings.as_json()
        return {**understood, "diagnostics": findings}

    def text(self) -> str:
        """Findings, worst first, then kind and counts of the contents."""
        lines = self.report.worst_first()
        counts = Counter(finding.severity for finding in self.report.findings)
        plural = {"error": "errors", "warning": "warnings", "info": "notes"}
        singular = {"error": "error", "warning": "warning", "info": "note"}
        parts = [f"{n} {(singular if n == 1 else plural)[s]}" for s in plural if (n := counts[s])]
        verdict = "refused" if self.findings is None else self.findings.sentence()
        return "\n".join([*lines, f"{self.file}: {verdict}; {', '.join(parts) or 'no findings'}"])


def check(file: str, environment: Mapping[str, str], *, start: Path, collisions: bool = False) -> CheckResult:
    """Read a file as far as possible, and check its physics.

    Args:
        file: a path, a folder with model.config, model://NAME, a launch file, or "-" for standard input.
        environment: variables that locate packages and models.
        start: packages are searched around it, too.
        collisions: cut hollow meshes as physics does, which may take a minute.
    """
    report = Diagnostics()
    packages = Packages(environment, start=start)
    found: Findings | None = None
    try:
        piped = read_piped(file)
        if _is_launch(file, piped):
            from .launch_file import check_launch  # each knows rooms that the other need not load

            found = check_launch(file, environment, packages=packages, report=report, piped=piped)
        else:
            from .description import check_description

            found = check_description(
                file, environment, packages=packages, start=start, report=report, collisions=collisions, piped=piped
            )
    except DescriptionError as error:
        report.error(error)
    except UsageError as error:
        report.error(DescriptionError(Source(file), str(error)))
    return CheckResult(file=file, findings=found, report=report)


def _is_launch(file: str, piped: Piped | None) -> bool:
    """True by the file's name, or by its root element."""
    if piped is None and not os.path.isfile(file):
        return False
    return file.endswith(_LAUNCH) or _LAUNCH_TAG.match(_start_of(file) if piped is None else piped.data) is not None


def _start_of(file: str) -> bytes:
    try:
        with open_file(file) as opened:
            return opened.read(_START_BYTES)
    except OSError:  # the reader reports it
        return b""
