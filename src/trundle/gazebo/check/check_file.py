"""`trundle check`: the contents of a file and findings about them; nothing in it is run."""

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
        """Return the contents, as `check --json` prints them."""
        ...

    def sentence(self) -> str:
        """Return kind and counts, on one line."""
        ...

    def trees(self) -> "list[TreeNode]":
        """Return the kinematic trees of the file."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckResult:
    """Contents of one file, and diagnostics about it."""

    file: str
    findings: Findings | None
    """None: the file was refused."""
    report: Diagnostics

    def trees(self) -> "list[TreeNode]":
        """Return the kinematic trees; none if the file was refused."""
        return [] if self.findings is None else self.findings.trees()

    @property
    def is_refused(self) -> bool:
        """True if the file could not be read."""
        return self.findings is None

    def as_json(self) -> dict[str, object]:
        """Return the resolved description and every finding."""
        findings = [finding.as_json() for finding in self.report.findings]
        contents: dict[str, object] = {"kind": None, "models": []}
        if self.findings is not None:
            contents = self.findings.as_json()
        return {**contents, "diagnostics": findings}

    def text(self) -> str:
        """Return the findings, worst first, then kind and counts of the contents."""
        lines = self.report.worst_first()
        counts = Counter(finding.severity for finding in self.report.findings)
        plural = {"error": "errors", "warning": "warnings", "info": "notes"}
        singular = {"error": "error", "warning": "warning", "info": "note"}
        parts = [f"{n} {(singular if n == 1 else plural)[s]}" for s in plural if (n := counts[s])]
        summary = "refused" if self.findings is None else self.findings.sentence()
        return "\n".join([*lines, f"{self.file}: {summary}; {', '.join(parts) or 'no findings'}"])


def check(file: str, environment: Mapping[str, str], *, start: Path, collisions: bool = False) -> CheckResult:
    """Read a file as far as possible, and check its physics.

    Args:
        file: a path, a folder with model.config, model://NAME, a launch file, or "-" for standard input.
        environment: variables that locate packages and models.
        start: packages are also searched around it.
        collisions: cut hollow meshes like physics, which may take a minute.
    """
    report = Diagnostics()
    packages = Packages(environment, start=start)
    findings: Findings | None = None
    try:
        piped = read_piped(file)
        if _is_launch(file, piped):
            from .launch_file import check_launch  # lazy: each module loads rooms that the other does not need

            findings = check_launch(file, environment, packages=packages, report=report, piped=piped)
        else:
            from .description import check_description

            findings = check_description(
                file, environment, packages=packages, start=start, report=report, collisions=collisions, piped=piped
            )
    except DescriptionError as error:
        report.error(error)
    except UsageError as error:
        report.error(DescriptionError(Source(file), str(error), error.id))
    return CheckResult(file=file, findings=findings, report=report)


def _is_launch(file: str, piped: Piped | None) -> bool:
    """Return True for a launch file, by its name or its root element."""
    if piped is None and not os.path.isfile(file):
        return False
    return file.endswith(_LAUNCH) or _LAUNCH_TAG.match(_read_start(file) if piped is None else piped.data) is not None


def _read_start(file: str) -> bytes:
    try:
        with open_file(file) as stream:
            return stream.read(_START_BYTES)
    except OSError:  # the reader reports it
        return b""
