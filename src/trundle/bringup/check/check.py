"""`trundle check`: what a file says, and what is doubtful about it; nothing in it is run."""

import os
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from trundle.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.files import open_file
from trundle.packages import Packages

from ..load_input import Piped, read_piped

if TYPE_CHECKING:
    from trundle.drawing.tree import TreeNode

_LAUNCH = (".launch", ".launch.py", ".launch.xml", ".test")
_LAUNCH_TAG = re.compile(rb"(?:\xef\xbb\xbf)?(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>]*>)*+<launch[\s/>]", re.DOTALL)
"""A document's start up to its root."""
_START_BYTES = 64 * 1024


class Findings(Protocol):
    """What was understood of a file."""

    def as_json(self) -> dict[str, object]:
        """All of it."""
        ...

    def sentence(self) -> str:
        """How much it is."""
        ...

    def trees(self) -> "list[TreeNode]":
        """The kinematic trees in it."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckResult:
    """What checking a file found."""

    file: str
    findings: Findings | None
    """None: the file was refused."""
    report: Diagnostics

    def trees(self) -> "list[TreeNode]":
        """The kinematic trees of what was understood."""
        return [] if self.findings is None else self.findings.trees()

    @property
    def is_refused(self) -> bool:
        """Whether nothing sensible could be made of the file."""
        return self.findings is None

    def as_json(self) -> dict[str, object]:
        """The resolved description and every finding."""
        findings = [finding.as_json() for finding in self.report.findings]
        understood = {"kind": None, "models": []} if self.findings is None else self.findings.as_json()
        return {**understood, "diagnostics": findings}

    def text(self) -> str:
        """Findings, worst first, and what was understood."""
        lines = self.report.worst_first()
        counts = Counter(finding.severity for finding in self.report.findings)
        plural = {"error": "errors", "warning": "warnings", "info": "notes"}
        singular = {"error": "error", "warning": "warning", "info": "note"}
        told = [f"{n} {(singular if n == 1 else plural)[s]}" for s in plural if (n := counts[s])]
        verdict = "refused" if self.findings is None else self.findings.sentence()
        return "\n".join([*lines, f"{self.file}: {verdict}; {', '.join(told) or 'nothing to remark'}"])


def check(file: str, environment: Mapping[str, str], *, start: Path, collisions: bool = False) -> CheckResult:
    """Read a file as far as it can be read, physics included.

    Args:
        file: a path, a folder with model.config, model://NAME, a launch file, or "-" for standard input.
        environment: says where packages and models are.
        start: packages are looked for around it too.
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
                file, packages=packages, start=start, report=report, collisions=collisions, piped=piped
            )
    except DescriptionError as error:
        report.error(error)
    except UsageError as error:
        report.error(DescriptionError(Source(file), str(error)))
    return CheckResult(file=file, findings=found, report=report)


def _is_launch(file: str, piped: Piped | None) -> bool:
    """By the name of a file, else by the root element."""
    if piped is None and not os.path.isfile(file):
        return False
    return file.endswith(_LAUNCH) or _LAUNCH_TAG.match(_start_of(file) if piped is None else piped.data) is not None


def _start_of(file: str) -> bytes:
    try:
        with open_file(file) as opened:
            return opened.read(_START_BYTES)
    except OSError:  # whoever reads all of it says so
        return b""
