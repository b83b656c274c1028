"""How to run the tests of a launch file, beside how to launch it."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchTestOptions:
    """What the command line may say; the defaults are rostest's."""

    junit: Path | None = None
    """Takes the results of all tests; None: a file where rostest leaves them."""
    text: bool = False
    """Tests print what they find, and leave no files unless `junit` names one."""
    package: str | None = None
    """Whose results they are; None: the package that the file lies in."""
    package_folder: Path | None = None
    """What the file's path counts from in the name of its results; None: the package's folder."""
    results_name: str | None = None
    """Of the results, with or without ending; None: from the file's path."""
    results_folder: Path | None = None
    """Has a folder for each package; None: ROS_TEST_RESULTS_DIR, or test_results in ROS_HOME."""
    reuse_master: bool = False
    """Run on the graph of ROS_MASTER_URI, rather than on one of the tests' own."""
    clear: bool = False
    """Delete the parameters that are on that graph, before each test."""
