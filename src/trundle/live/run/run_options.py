"""Options of `trundle run`."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from trundle.base.http.page_address import AllowedNames
from trundle.sim.renderers import RendererName

OnInstability: TypeAlias = Literal["pause", "reset", "exit"]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunOptions:
    """Options of `trundle run`, with its defaults."""

    headless: bool = False
    host: str = "127.0.0.1"
    port: int | None = None
    """Port of the page; None: 8080 or the next free one."""
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves besides its own."""
    view_only: bool = False
    """True: print a second link, which is view-only."""
    opens_browser: bool = True
    """True: open the page where there is a display; False: only print its URL."""
    lesson: str | None = None
    """Lesson that the page opens: a name, or a path FILE.md."""
    duration_s: float | None = None
    """Simulation time [s]; None: until interrupted."""
    speed: float | None = 1.0
    """Simulated seconds per second of wall time; None: flat out."""
    paused: bool = False
    seed: int = 0
    ros: bool = True
    sensors: bool = True
    renderer: RendererName = "cpu"
    """Renderer of cameras: Trundle's own, or OpenGL over EGL."""
    strict: bool = False
    record: Path | None = None
    """Path of the state log to write."""
    compare: Path | None = None
    """Recording to compare the run with, on its page."""
    timeline_mb: int = 256
    """Memory of the timeline, with a page [MB]; 0: none."""
    on_instability: OnInstability | None = None
    """Reaction to unstable physics; None: pause if there is a page, else exit."""
