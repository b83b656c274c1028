"""A launch file that was read; a module of its own, so that whoever only asks loads nothing that runs nodes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from trundle.diagnostics import Diagnostics
from trundle.launch import LaunchParam, LaunchPlan
from trundle.packages import Packages

from ..console import Console


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedLaunch:
    """A launch that was read: its commands have run, nothing of it is started."""

    plan: LaunchPlan
    params: Sequence[LaunchParam]
    packages: Packages
    start: Path
    """What packages are searched around."""
    env: Mapping[str, str]
    report: Diagnostics
    show: Console
