"""Results of tests: read from a test program's XML, written as JUnit XML."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.base.xmlnode import XmlNode, read_xml


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseResult:
    """One case of a test."""

    name: str
    seconds: float = 0.0
    problem: str = ""
    """Message of the failure; empty if the case passed."""
    is_error: bool = False
    """True if the case could not be run; False if it failed or passed."""

    @property
    def verdict(self) -> str:
        """passed, failed or error."""
        return "passed" if not self.problem else "error" if self.is_error else "failed"


@dataclass(frozen=True, slots=True, kw_only=True)
class SuiteResult:
    """Cases of one <test>."""

    name: str
    seconds: float
    cases: tuple[CaseResult, ...]
    did_run: bool = True
    """True if its program ended in time and left results."""

    @property
    def failures(self) -> int:
        """Cases that failed."""
        return sum(case.verdict == "failed" for case in self.cases)

    @property
    def errors(self) -> int:
        """Cases that could not be run."""
        return sum(case.verdict == "error" for case in self.cases)


def read_result(file: Path, name: str) -> list[CaseResult]:
    """Read the XML of gtest, unittest or pytest; a malformed file is an error of the test `name`."""
    try:
        root = read_xml(file)
    except DescriptionError as error:
        return [CaseResult(name=name, problem=str(error), is_error=True)]
    suites = [root] if root.tag == "testsuite" else root.all("testsuite")
    cases = [_case(case) for suite in suites for case in suite.all("testcase")]
    return cases or [CaseResult(name=name, problem=f"{file} holds no test case", is_error=True)]


def _case(node: XmlNode) -> CaseResult:
    failure, error = node.find("failure"), node.find("error")
    problem = failure if failure is not None else error
    text = "" if problem is None else (problem.attribute("message") or problem.text or "it failed").strip()
    try:
        seconds = float(node.attribute("time") or 0.0)
    except ValueError:
        seconds = 0.0
    return CaseResult(name=node.attribute("name") or "?", seconds=seconds, problem=text, is_error=failure is None)


def write_junit(file: Path, suites: Sequence[SuiteResult]) -> None:
    """Write JUnit XML, as CI servers read it.

    Raises:
        UsageError: the file cannot be written.
    """
    root = ET.Element("testsuites")
    for suite in suites:
        counts = {"tests": len(suite.cases), "failures": suite.failures, "errors": suite.errors}
        attributes = {"name": suite.name, "time": f"{suite.seconds:.3f}", **{k: str(v) for k, v in counts.items()}}
        parent = ET.SubElement(root, "testsuite", attributes)
        for case in suite.cases:
            node = ET.SubElement(parent, "testcase", classname=suite.name, name=case.name, time=f"{case.seconds:.3f}")
            if case.problem:
                tag = "error" if case.is_error else "failure"
                ET.SubElement(node, tag, message=_printable(case.problem.partition("\n")[0])).text = _printable(
                    case.problem
                )
    ET.indent(root)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"results cannot be written to {file}: {error.strerror}") from None
    write_atomically(file, ET.tostring(root, encoding="unicode") + "\n")


def _printable(text: str) -> str:
    """Replace control characters, which XML forbids, by "?"."""
    return "".join(char if char >= " " or char in "\t\n" else "?" for char in text)
