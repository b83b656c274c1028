"""Runner of unittests that writes JUnit's XML."""

import contextlib
import io
import re
import sys
import time
import traceback
import unittest
from pathlib import Path
from types import TracebackType
from typing import Any, TextIO
from xml.sax.saxutils import escape, quoteattr

_NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_Error = tuple[type[BaseException], BaseException, TracebackType] | tuple[None, None, None]


class XMLTestRunner:
    """Runs a suite; the tests' output goes into the file."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def run(self, test: unittest.TestSuite) -> "XMLTestResult":
        """Run a suite, write the file, print a line per test."""
        suite = type(test)
        result = XMLTestResult(f"{suite.__module__}.{suite.__name__}")
        begin = time.monotonic()
        with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
            test(result)
        text = result.xml(time.monotonic() - begin, out.getvalue(), err.getvalue())
        self._path.write_text(text, encoding="utf-8")
        result.print_report(sys.stdout)
        return result


class XMLTestResult(unittest.TestResult):
    """Result that stores each test's duration and failure."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self._name = name
        self._cases: list[tuple[unittest.TestCase, float, str, _Error | None]] = []
        self._begin = 0.0
        self._failed: tuple[str, _Error | None] = "", None

    def startTest(self, test: unittest.TestCase) -> None:
        """Record the start of a test."""
        super().startTest(test)
        self._begin, self._failed = time.monotonic(), ("", None)

    def stopTest(self, test: unittest.TestCase) -> None:
        """Record the end of a test."""
        super().stopTest(test)
        self._cases.append((test, time.monotonic() - self._begin, *self._failed))

    def addError(self, test: Any, err: Any) -> None:
        """Record an error."""
        super().addError(test, err)
        self._failed = "error", err

    def addFailure(self, test: Any, err: Any) -> None:
        """Record a failure."""
        super().addFailure(test, err)
        self._failed = "failure", err

    def print_report(self, stream: TextIO) -> None:
        """Print how each test ended."""
        for test, _, kind, error in self._cases:
            name = test.id().rpartition(".")[2]
            if error is None or error[0] is None:
                stream.write(f"[Testcase: {name}] ... ok\n")
                continue
            text = escape(f"{kind.upper()}: {error[1]}\n{_lines(error)}")
            stream.write(f"[Testcase: {name}] ... {kind.upper()}!\n{text}{'-' * 80}\n\n")

    def xml(self, seconds: float, out: str, err: str) -> str:
        """JUnit's XML, with the tests' output."""
        head = f"errors={quoteattr(str(len(self.errors)))} failures={quoteattr(str(len(self.failures)))}"
        lines = [
            '<?xml version="1.0" encoding="utf-8"?>',
            f'<testsuite {head} name={quoteattr(self._name)} tests="{self.testsRun}" time="{seconds:.3f}">',
        ]
        for test, duration_s, kind, error in self._cases:
            class_name, _, name = test.id().rpartition(".")
            lines.append(f'<testcase classname={quoteattr(class_name)} name={quoteattr(name)} time="{duration_s:.4f}">')
            if error is not None and error[0] is not None:
                text = escape(_printable(f"{error[1]}\n{_lines(error)}"))
                lines.append(f"<{kind} type={quoteattr(error[0].__name__)}>{text}</{kind}>")
            lines.append("</testcase>")
        output = [
            f"<{tag}>{escape(_printable(text))}</{tag}>" for tag, text in (("system-out", out), ("system-err", err))
        ]
        return "\n".join([*lines, *output, "</testsuite>", ""])


def _lines(error: _Error) -> str:
    return "".join(traceback.format_tb(error[2]))


def _printable(text: str) -> str:
    """Text without the characters that XML does not allow."""
    return _NOT_IN_XML.sub("?", text)
