"""Running unittests with results in JUnit's XML."""

from .baretest import print_unittest_summary
from .core import XML_OUTPUT_FLAG, create_xml_runner, rostest_name_from_path, xml_results_file
from .pyunit import unitrun

__all__ = [
    "XML_OUTPUT_FLAG", "create_xml_runner", "print_unittest_summary", "rostest_name_from_path", "unitrun",
    "xml_results_file",
]  # fmt: skip
