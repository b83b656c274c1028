"""Page that takes gzclient's place, opened when a node asks for it."""

from collections.abc import Callable, Sequence

from trundle.diagnostics import TrundleError
from trundle.page import GraphAddress
from trundle.page_address import PageAddress
from trundle.ros import Node
from trundle.sensors import CameraSensor, InstrumentSensor
from trundle.simulation import Simulation

from ..realtime_pacer import RealtimePacer
from ..simulation_page.page import SimulationPage
from ..state_logs import PageRecording

_CMD_VEL = "/cmd_vel"


class GzclientPage:
    """Page of the world behind /gazebo; all but `url`, `is_over` and `is_wanted` belongs to the simulation's thread."""

    def __init__(self, at: PageAddress | None, graph: GraphAddress, say: Callable[[str], None]) -> None:
        """Prepare; `open` serves the page.

        Args:
            at: address of the page; None: headless.
            graph: ROS graph that the page joins.
            say: prints the page's URL.
        """
        self._at = at
        self._graph = graph
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
            self._page = SimulationPage.open(
                simulation,
                sensors,
                self._at,
                graph=self._graph,
                node=node,
                drive_topic=_CMD_VEL,
                recorder=PageRecording(simulation, self._say),
            )
        except TrundleError as error:
            node.log.error(str(error))
            self._at = None
        else:
            self._say(f"see the simulation at {self._page.url}")

    def set_sensors(self, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        """Set the sensors that measure after models came or went."""
        if self._page is not None:
            self._page.set_sensors(sensors)

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
