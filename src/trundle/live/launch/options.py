"""Options of a launch."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from trundle.base.http.page_address import AllowedNames


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchOptions:
    """Options of `trundle launch`, with its defaults."""

    headless: bool = False
    duration_s: float | None = None
    """ROS time [s]; None: until every node has ended."""
    master_port: int | None = None
    view_port: int | None = None
    host: str = "127.0.0.1"
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves besides its own."""
    view_only: bool = False
    """True: print a second link, which is view-only."""
    opens_browser: bool = True
    """True: open the page where there is a display; False: only print its URL."""
    lesson: str | None = None
    """Lesson that the page opens: a name, or a path FILE.md."""
    renderer: Literal["cpu", "egl"] = "cpu"
    """See `RunOptions.renderer`."""
    output: Literal["screen", "log"] | None = None
    """Output of every node; overrides the file's."""
    reads_keys: bool = False
    """True: nodes may read the terminal in which the launch runs."""
    all_required: bool = False
    wait_for_master: bool = False
    summary: bool = True
    verbose: bool = False
    core_only: bool = False
    pid_file: Path | None = None
    interrupt_s: float = 15.0
    terminate_s: float = 2.0
    """Timeouts [s] after SIGINT, then after SIGTERM; the defaults are roslaunch's."""
    strict: bool = False
    quiet: bool = False
    """Print failures only."""
    distro: str | None = None
    """ROS distribution; None: the master's, Noetic if it is started here."""
    speed: float | None = 1.0
    """Simulated seconds per second of wall time; None: flat out."""
    in_step: bool = False
    """True: time waits for the nodes at each step, at any speed; flat out it always does."""
    record: Path | None = None
    """Path of a bag that records every topic."""
    record_from_s: float = 0.0
    """Start time of a bag in lockstep [s]."""
    record_without: frozenset[str] = frozenset()
    """Message types that the bag leaves out."""
    only: Literal["nodes", "files", "find-node", "args", "arguments", "params", "translation"] | None = None
    """Part of the launch to print instead of starting it."""
    timeline_mb: int = 256
    """Memory of the timeline, with a page [MB]; 0: none."""
    node: str = ""
    """Name of the node for `find-node` and `args`."""
