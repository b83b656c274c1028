"""Running a test program."""

import sys
import unittest
from collections.abc import Sequence
from typing import Any

from .baretest import print_unittest_summary
from .core import XML_OUTPUT_FLAG, create_xml_runner


def unitrun(
    package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None, coverage_packages: Any = None
) -> None:
    """Run a TestCase or a suite's name; writes results to `--gtest_output=xml:FILE`, and exits with 1 on failure.

    Args:
        package: test's package.
        test_name: name of the results.
        test: TestCase, or a suite's name.
        sysargs: command line; default: sys.argv. `--text` prints results as unittest does, without a file.
        coverage_packages: no effect.
    """
    del coverage_packages
    arguments = sys.argv if sysargs is None else sysargs
    loader = unittest.TestLoader()
    suite = loader.loadTestsFromName(test) if isinstance(test, str) else loader.loadTestsFromTestCase(test)
    files = [argument.removeprefix(XML_OUTPUT_FLAG) for argument in arguments if argument.startswith(XML_OUTPUT_FLAG)]
    if "--text" in arguments:
        result = unittest.TextTestRunner(verbosity=2).run(suite)
    else:
        result = create_xml_runner(package, test_name, files[-1] if files else None).run(suite)
    print_unittest_summary(result)
    if not result.wasSuccessful():
        sys.exit(1)
