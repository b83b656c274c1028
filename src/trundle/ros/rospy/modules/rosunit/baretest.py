"""Summary of tests."""

import unittest
from typing import Any

_RULE = "-" * 61


def print_unittest_summary(result: unittest.TestResult) -> None:
    """Print how many tests ran, and which failed."""
    verdict = "\033[32m * RESULT: SUCCESS\033[0m" if result.wasSuccessful() else " * RESULT: FAIL"
    print(f"{_RULE}\nSUMMARY:\n{verdict}\n * TESTS: {result.testsRun}")
    print(f" * ERRORS: {len(result.errors)} [{_names(result.errors)}]")
    print(f" * FAILURES: {len(result.failures)} [{_names(result.failures)}]\n")


def _names(failed: list[tuple[Any, str]]) -> str:
    return ", ".join(getattr(test, "_testMethodName", str(test)) for test, _ in failed)
