"""Page that takes gzclient's place, opened when a node asks for it."""

from collections.abc import Callable, Sequence

from trundle.diagnostics import TrundleError
from trundle.page_address import PageAddress
from trundle.ros import Node
from trundle.sensors import CameraSensor, InstrumentSensor
from trundle.simulation import Simulation

from ..page import SimulationPage
from ..realtime_pacer import RealtimePacer


class GzclientPage:
    """Page of the world behind /gazebo; all but `url`, `is_over` and `is_wanted` belongs to the simulation's thread."""

    def __init__(self, at: PageAddress | None, say: Callable[[str], None]) -> None:
        """Prepare; `open` serves the page.

        Args:
            at: address of the page; None: headless.
            say: prints the page's URL.
        """
        self._at = at
        self._say = say
        self._page: SimulationPage | None = None

    @property
    def url(self) -> str | None:
        """URL of the page; None before it is served."""
        page = self._page
        return None if page is None else page.url

    @property
    def is_over(self) -> bool:
        """True if there will be no page."""
        return self._at is None

    @property
    def is_wanted(self) -> bool:
        """True if the page is still to be opened."""
        return self._at is not None and self._page is None

    def open(self, simulation: Simulation, sensors: Sequence[CameraSensor | InstrumentSensor], node: Node) -> None:
        """Open the page unless it is open; a failure is logged by the node."""
        if self._at is None or self._page is not None:
            return
        try:
            self._page = SimulationPage.open(simulation, sensors, None, self._at)
        except TrundleError as error:
            node.log.error(str(error))
            self._at = None
        else:
            self._say(f"see the simulation at {self._page.url}")

    def reload(self, simulation: Simulation, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        """Rebuild the scene after models or lights came or went."""
        if self._page is not None:
            self._page.reload(simulation, sensors)

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
