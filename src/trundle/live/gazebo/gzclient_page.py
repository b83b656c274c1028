"""Page in place of gzclient's window; a node requests to open it."""

from collections.abc import Callable

from trundle.base.diagnostics import TrundleError
from trundle.page.shared_page import SharedPage
from trundle.page.simulated_world.page import SimulationPage
from trundle.ros import Node
from trundle.sim.realtime_pacer import RealtimePacer

from ..live_world import LiveWorld
from ..state_logs import PageRecording


class GzclientPage:
    """Page of the world behind /gazebo; only `url` and `is_pending` may be read from other threads."""

    def __init__(
        self, shared: SharedPage | None, say: Callable[[str], None], *, reload: Callable[[], None] | None
    ) -> None:
        """Prepare; `open` serves the page.

        Args:
            shared: page of the graph's windows; None: headless.
            say: prints a line.
            reload: loads the world again; None: not supported.
        """
        self._shared = shared
        self._reload = reload
        self._say = say
        self._page: SimulationPage | None = None

    @property
    def url(self) -> str | None:
        """URL of the page; None until the page is served."""
        return None if self._shared is None else self._shared.url

    @property
    def is_pending(self) -> bool:
        """True if the page may be opened, but is not open yet."""
        return self._shared is not None and self._page is None

    def open(self, live: LiveWorld, node: Node) -> None:
        """Open the page unless it is open; a failure is logged by the node."""
        if self._shared is None or self._page is not None:
            return
        try:
            recorder = PageRecording(live.simulation, self._say)
            self._page = SimulationPage(self._shared, live, node=node, recorder=recorder)
            self._page.on_reload = self._reload
        except TrundleError as error:
            node.log.error(str(error))
            self._shared = None

    def update(self, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Handle the page's requests and send it the state; return True if the simulation is paused now."""
        if self._page is not None:
            paused = self._page.handle_requests(pacer, paused=paused)
            self._page.update(pacer, paused=paused)
        return paused

    def close(self) -> None:
        """Close the page."""
        if self._page is not None:
            self._page.close()
            self._page = None
