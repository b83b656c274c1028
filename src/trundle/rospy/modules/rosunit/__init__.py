"""Running unittests with results in JUnit's XML."""

import sys
import time
import unittest
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape, quoteattr

_OUTPUT = "--gtest_output=xml:"


def unitrun(
    package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None, coverage_packages: Any = None
) -> None:
    """Run a TestCase or a suite's name; writes results to `--gtest_output=xml:FILE`, and exits with 1 on failure.

    Args:
        package: that the test belongs to.
        test_name: name of the results.
        test: a TestCase, or the name of a suite.
        sysargs: command line; sys.argv by default.
        coverage_packages: no effect.
    """
    del coverage_packages
    loader = unittest.TestLoader()
    suite = loader.loadTestsFromName(test) if isinstance(test, str) else loader.loadTestsFromTestCase(test)
    result = unittest.TextTestRunner(verbosity=2, resultclass=_Result, stream=sys.stdout).run(suite)
    assert isinstance(result, _Result)
    for argument in sys.argv if sysargs is None else sysargs:
        if argument.startswith(_OUTPUT):
            path = Path(argument.removeprefix(_OUTPUT))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(_xml(f"{package}.{test_name}", result), encoding="utf-8")
    sys.exit(0 if result.wasSuccessful() else 1)


class _Result(unittest.TextTestResult):
    """Result that times each test."""

    def __init__(self, *arguments: Any, **keywords: Any) -> None:
        super().__init__(*arguments, **keywords)
        self.times: list[tuple[unittest.TestCase, float]] = []
        self._begin = 0.0

    def startTest(self, test: unittest.TestCase) -> None:
        """Note the begin of a test."""
        self._begin = time.monotonic()
        super().startTest(test)

    def stopTest(self, test: unittest.TestCase) -> None:
        """Note the end of a test."""
        self.times.append((test, time.monotonic() - self._begin))
        super().stopTest(test)


def _xml(name: str, result: _Result) -> str:
    failures, errors = ({str(test): text for test, text in each} for each in (result.failures, result.errors))
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        f'<testsuite name={quoteattr(name)} tests="{result.testsRun}" failures="{len(failures)}" '
        f'errors="{len(errors)}" time="{sum(seconds for _, seconds in result.times):.3f}">',
    ]
    for test, seconds in result.times:
        head = f"  <testcase classname={quoteattr(name)} name={quoteattr(test.id().rpartition('.')[2])}"
        lines.append(f'{head} time="{seconds:.3f}">')
        for kind, texts in (("failure", failures), ("error", errors)):
            if str(test) in texts:
                lines.append(f"    <{kind}>{escape(texts[str(test)])}</{kind}>")
        lines.append("  </testcase>")
    return "\n".join([*lines, "</testsuite>", ""])
