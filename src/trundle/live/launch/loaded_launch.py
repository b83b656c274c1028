"""A launch file after reading; a separate module, so that options such as `--nodes` import nothing that runs nodes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics
from trundle.robots.launch import LaunchParam, LaunchPlan
from trundle.robots.packages import Packages


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedLaunch:
    """A launch after reading: its commands have run, no node has started."""

    plan: LaunchPlan
    params: Sequence[LaunchParam]
    packages: Packages
    start: Path
    """File or folder around which packages are searched."""
    env: Mapping[str, str]
    report: Diagnostics
    show: Console
