"""Files of results, and the runner that writes them."""

import os
from pathlib import Path

import rospkg

from .xmlrunner import XMLTestRunner

XML_OUTPUT_FLAG = "--gtest_output=xml:"
_NOT_IN_NAMES = str.maketrans(dict.fromkeys(" \"'&$!`/\\", "_"))


def xml_results_file(
    test_pkg: str, test_name: str, is_rostest: bool = False, env: dict[str, str] | None = None
) -> str:  # fmt: skip
    """Path of a test's results; its folder is created."""
    folder = os.path.join(rospkg.get_test_results_dir(env=env), test_pkg)
    os.makedirs(folder, exist_ok=True)
    kind = "rostest" if is_rostest else "rosunit"
    return os.path.join(folder, f"{kind}-{test_name.translate(_NOT_IN_NAMES)}.xml")


def rostest_name_from_path(pkg_dir: str, test_file: str) -> str:
    """Name of a test, from its file's path in its package."""
    path = os.path.abspath(test_file)
    relative = path.removeprefix(pkg_dir).removeprefix(os.sep) if path.startswith(pkg_dir) else test_file
    name = relative.replace(os.sep, "_")
    return name.rpartition(".")[0] if "." in name else name


def create_xml_runner(
    test_pkg: str, test_name: str, results_file: str | None = None, is_rostest: bool = False
) -> XMLTestRunner:
    """Runner that writes results in JUnit's XML, to the test's own file by default."""
    path = Path(results_file or xml_results_file(test_pkg, os.path.basename(test_name), is_rostest))
    path.parent.mkdir(parents=True, exist_ok=True)
    print(f"[ROSUNIT] Outputting test results to {path}")
    return XMLTestRunner(path)
