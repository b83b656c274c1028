"""How to launch."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from trundle.page_address import AllowedNames


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchOptions:
    """What the command line may say; the defaults are those of `trundle launch`."""

    headless: bool = False
    duration_s: float | None = None
    """ROS time; None: until every node has ended."""
    master_port: int | None = None
    view_port: int | None = None
    host: str = "127.0.0.1"
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves beside its own."""
    renderer: Literal["cpu", "egl"] = "cpu"
    """As `RunOptions.renderer`."""
    output: Literal["screen", "log"] | None = None
    """Of every node, whatever the file says."""
    all_required: bool = False
    wait_for_master: bool = False
    summary: bool = True
    verbose: bool = False
    core_only: bool = False
    pid_file: Path | None = None
    interrupt_s: float = 15.0
    terminate_s: float = 2.0
    """How long a node may take to end after SIGINT, then after SIGTERM [s]; the defaults are roslaunch's."""
    strict: bool = False
    quiet: bool = False
    """Say only what goes wrong."""
    distro: str | None = None
    """Which distribution to be; None: what the master says it is, Noetic where it is started here."""
    speed: float | None = 1.0
    """Of a simulation, times real time; None: flat out."""
    record: Path | None = None
    """A bag to write every topic into."""
    only: Literal["nodes", "files", "find-node", "args", "arguments", "params"] | None = None
    """Print these and start nothing."""
    node: str = ""
    """Which node `find-node` and `args` are about."""
