"""Options of `trundle test` in addition to those of the launch."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchTestOptions:
    """Options of `trundle test`, with rostest's defaults."""

    junit: Path | None = None
    """Path of the file of all results; None: rostest's default path."""
    text: bool = False
    """True: print results rather than write them, unless `junit` names a file."""
    package: str | None = None
    """Package of the results; None: the one that contains the file."""
    package_folder: Path | None = None
    """Base folder of the file's path in the results' name; None: the package's folder."""
    results_name: str | None = None
    """Name of the results, with or without suffix; None: from the file's path."""
    results_folder: Path | None = None
    """Parent of each package's folder; None: ROS_TEST_RESULTS_DIR, or test_results in ROS_HOME."""
    reuse_master: bool = False
    """True: run on the graph of ROS_MASTER_URI rather than on a new one."""
    clear: bool = False
    """True: delete that graph's parameters before each test."""
