"""Page of a simulation that a program steps: `LoadedSimulation.view`."""

import asyncio
import html
import time
from typing import TYPE_CHECKING, Self

from trundle.base.arguments import number_of
from trundle.base.documented import documented
from trundle.base.http.page_address import AllowedNames, PageAddress
from trundle.base.waiting import print_line
from trundle.page import GraphAddress
from trundle.page.network_warning import warn_of_network
from trundle.page.shared_page import SharedPage
from trundle.page.simulated_world.page import SimulationPage
from trundle.sim.realtime_pacer import STRIDE_FLAT_OUT_NS, RealtimePacer

from .notebook import is_notebook, notebook_origins
from .state_logs import PageRecording

if TYPE_CHECKING:
    from .live_world import LiveWorld
    from .run.ros_interface import RosInterface

_STRIDE_WALL_NS = 20_000_000
"""Wall time between two exchanges with the page [ns]."""
_LONGEST_STRIDE_NS = 1_000_000_000
"""Longest simulation time between two exchanges [ns]."""
_PAUSED_S = 0.02
"""Period at which a paused page is polled [s]."""
_HEIGHT_PX = 640


@documented("url is_open is_watched is_paused speed real_time_factor sync close")
class View:
    """Page in the browser, or in a notebook, that shows and edits a simulation while a program steps it.

    `run` and `step` keep it up to date and answer its requests, at most at `speed`; while its *Pause* is pressed, they
    wait. In a notebook it also answers between two cells.
    """

    __module__ = "trundle"

    def __init__(
        self,
        world: "LiveWorld",
        ros: "RosInterface | None",
        *,
        speed: float | None = 1.0,
        host: str = "127.0.0.1",
        port: int | None = None,
    ) -> None:
        """Serve the page; see `LoadedSimulation.view`."""
        pace = None if speed is None else number_of(speed, "speed [simulated s per s]", minimum=1e-3)
        self._world = world
        self._simulation = world.simulation
        self._pacer = RealtimePacer(pace)
        self._is_paused = self._is_exchanging = False
        self._due_ns = 0
        say = _say_nothing if is_notebook() else print_line
        warn_of_network(host, say)
        self._shared = SharedPage(
            say=say,
            at=PageAddress(host=host, port=port, allowed=AllowedNames(origins=notebook_origins())),
            graph=None if ros is None else GraphAddress(master_uri=ros.graph.master_uri, host=ros.graph.host),
        )
        world.start_sensors()
        self._page: SimulationPage | None = SimulationPage(
            self._shared,
            world,
            node=None if ros is None else ros.node,
            recorder=PageRecording(self._simulation, say),
        )
        self.url = self._shared.url or ""
        """Link that opens the page; its token admits whoever has it."""
        self.sync()
        self._answer_between_cells()

    @property
    def is_open(self) -> bool:
        """True until `close`."""
        return self._page is not None

    @property
    def is_watched(self) -> bool:
        """True while a browser draws the page."""
        return self._page is not None and self._page.is_watched

    @property
    def is_paused(self) -> bool:
        """True while *Pause* of the page is pressed; `run`, `step` and `sync` wait."""
        return self._is_paused

    @property
    def speed(self) -> float | None:
        """Largest speed [simulated s per s]; None: as fast as possible. The page may change it, too."""
        return self._pacer.speed

    @speed.setter
    def speed(self, speed: float | None) -> None:
        self._pacer.set_speed(None if speed is None else number_of(speed, "speed [simulated s per s]", minimum=1e-3))

    @property
    def real_time_factor(self) -> float | None:
        """Ratio of simulated to wall time in the last moments; None: not measured yet."""
        return self._pacer.real_time_factor

    @property
    def stride_ns(self) -> int:
        """Longest time to simulate between two calls of `follow` [ns]; called by the simulation only."""
        speed = self.speed
        return STRIDE_FLAT_OUT_NS if speed is None else max(1, int(min(_STRIDE_WALL_NS * speed, _LONGEST_STRIDE_NS)))

    def sync(self) -> None:
        """Show the present state at once and answer the page's requests.

        It waits while the simulation is ahead of the wall clock at `speed`, and while it is paused.
        """
        self._due_ns = 0
        self.follow()

    def follow(self) -> None:
        """Act as `sync` if an exchange is due; called by the simulation only."""
        if self._is_exchanging or not self.is_open:
            return
        now_ns = time.monotonic_ns()
        if now_ns >= self._due_ns:
            self._exchange(at_once=self._due_ns == 0)
            self._due_ns = now_ns + _STRIDE_WALL_NS
        while self.is_open and (self._is_paused or self._is_ahead()):
            if self._is_paused:
                time.sleep(_PAUSED_S)
            self._exchange()

    def _is_ahead(self) -> bool:
        """Sleep while simulation time is ahead of the wall clock; True if it still is."""
        time_ns = self._simulation.time_ns
        return self._pacer.next_target(time_ns) == time_ns

    def _exchange(self, *, at_once: bool = False) -> None:
        """Answer the requests, and send the streams that are due."""
        assert self._page is not None
        self._is_exchanging = True
        try:
            self._is_paused = self._page.handle_requests(self._pacer, paused=self._is_paused)
            self._page.update(self._pacer, paused=self._is_paused, at_once=at_once)
            self._simulation.inputs.run_calls()
        finally:
            self._is_exchanging = False
        if self._is_paused:
            self._pacer.restart()

    def _answer_between_cells(self) -> None:
        """Answer the page whenever a notebook's event loop is idle; a program without such a loop calls `sync`."""
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            return

        def answer() -> None:
            if self.is_open:
                if not self._is_exchanging:
                    self._exchange()
                    self._pacer.restart()
                loop.call_later(_PAUSED_S, answer)

        loop.call_later(_PAUSED_S, answer)

    def close(self) -> None:
        """Close the page; the simulation goes on without it."""
        page, self._page = self._page, None
        self._is_paused = False
        if page is not None:
            page.end_recording()
            page.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<View at {self.url}>" if self.is_open else "<View, closed>"

    def _repr_html_(self) -> str:
        """Return a frame with the page, for notebooks, and a link.

        The frame's host is the notebook's, so that a browser keeps its cookie: `localhost` and `127.0.0.1` are other
        sites to it.
        """
        if not self.is_open:
            return "<p>The view is closed.</p>"
        url = html.escape(self.url)
        return (
            f'<iframe src="{url}" title="Trundle" style="width: 100%; height: {_HEIGHT_PX}px; border: 0"></iframe>'
            "<script>{const frame = document.currentScript.previousElementSibling;"
            ' if (location.hostname === "localhost") frame.src = frame.src.replace("//127.0.0.1:", "//localhost:");}'
            f'</script><p><a href="{url}" target="_blank">Open it in a window of its own</a></p>'
        )


def _say_nothing(line: str) -> None:
    """Print nothing: a notebook shows the view itself."""
    del line
