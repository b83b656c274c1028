"""What a stand-in is, and what it may ask of the program it runs in."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from trundle.ros import Node
from trundle.spatial import Pose
from trundle.supervisor import ProcessTree

if TYPE_CHECKING:
    from trundle.model import World
    from trundle.sensors import CameraSensor, InstrumentSensor
    from trundle.simulation import Simulation


@dataclass(frozen=True, slots=True, kw_only=True)
class Slider:
    """A joint that a user may move by hand; limits are finite [rad] or [m]."""

    name: str
    lower: float
    upper: float
    position: float


class Display(Protocol):
    """Shows the graph in a browser; a launch has one page, however many rviz nodes it starts."""

    def offer_sliders(self, sliders: Sequence[Slider], move: Callable[[str, float], None]) -> None:
        """Let the user move joints; `move` takes a joint's name and position, on any thread."""
        ...

    def drive_on(self, topic: str) -> None:
        """Have the page's pad drive what listens there; the first topic that is asked for stays."""
        ...

    def show_image(self, topic: str) -> None:
        """Have the page show the images of a topic, beside those of an rviz configuration."""
        ...

    def offer_options(self) -> None:
        """Let the user change the options of every node that has some, as rqt_reconfigure does."""
        ...

    def show_graph(self) -> None:
        """Have the page draw who publishes what to whom, as rqt_graph does."""
        ...

    def plot(self, fields: Sequence[str]) -> None:
        """Have the page draw numbers over time, as rqt_plot does; fields are `/topic/field/…`."""
        ...

    def offer_joystick(self, move: Callable[[Sequence[float], Sequence[int]], None]) -> None:
        """Let the user move a joystick, on the page or a real one; `move` takes axes and buttons as `joy` has them."""
        ...

    async def show(self, node: Node, *, config: str | None, fixed_frame: str | None) -> int:
        """Show until the page is closed for good or the call is cancelled; return an exit code.

        Args:
            node: the rviz node, for subscriptions and publications of its displays and tools.
            config: an .rviz file as the launch file names it; it may not be there.
            fixed_frame: overrides the file's.
        """
        ...


class Simulator(Protocol):
    """The one simulation of a launch, on a thread of its own.

    All but `open`, `close`, `post` and `show` is called on that thread.
    """

    @property
    def simulation(self) -> "Simulation":
        """The world in motion."""
        ...

    @property
    def sensors(self) -> "Sequence[CameraSensor | InstrumentSensor]":
        """Everything there that measures."""
        ...

    @property
    def paused(self) -> bool: ...

    @property
    def is_lockstep(self) -> bool:
        """Whether time waits for nodes, as it does flat out; they then act by it alone, that runs repeat."""
        ...

    async def open(
        self, node: Node, world: str, *, paused: bool, env: Mapping[str, str], record: str | None = None
    ) -> None:
        """Read a world and let it run.

        Args:
            node: publishes its time; its callbacks run on the thread.
            world: a file of the launch, or one that is found where Gazebo looks.
            paused: whether time stands still at first.
            env: variables beside the launch's own, such as GAZEBO_MODEL_PATH.
            record: folder for state logs, "" for the usual one; None: none are written.

        Raises:
            TrundleError: no such world, one that cannot be read, or there is one already.
        """
        ...

    def close(self) -> None:
        """End the simulation; waits for its thread, so that it is not called there, nor on the graph's loop."""
        ...

    def post(self, call: Callable[[], None]) -> None:
        """Have a function called between two strides, even while the simulation is paused; from any thread."""
        ...

    def set_paused(self, paused: bool) -> None: ...

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add the model that an SDF or URDF text describes.

        Raises:
            TrundleError: the name is taken, or the text is no model.
        """
        ...

    def delete(self, name: str) -> None:
        """Remove a model.

        Raises:
            TrundleError: there is none.
        """
        ...

    def edit(self, world: "World") -> None:
        """Go on with other gravity, masses, limits or lights.

        Raises:
            TrundleError: it cannot be simulated; nothing has changed.
        """
        ...

    def set_speed(self, speed: float | None) -> None:
        """Simulate so many seconds a second of the wall; None: as many as there can be."""
        ...

    def reset(self, *, time: bool) -> None:
        """Put every model back to where it was when it came; `time` goes back to zero, too."""
        ...

    async def show(self, node: Node) -> int:
        """Be the window until it is cancelled; return an exit code."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeHost:
    """What the program offers its stand-ins."""

    display: Display | None = None
    """None: headless; rviz idles."""
    simulator: Simulator | None = None
    """None: nothing can be simulated here."""
    env: Mapping[str, str] = field(default_factory=dict[str, str])
    """Variables that the launch file sets for this node."""
    tree: ProcessTree = field(default_factory=ProcessTree)
    """The node's own processes belong to it, and end with it."""


class BuiltinNode(Protocol):
    """A node that runs in this process in place of a stock executable.

    Made on the graph's loop with `(node, arguments, host)`: `arguments` is the command line without the program and
    without what ROS itself reads. It tells and waits for time through `node.clock` alone.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None: ...

    async def run(self) -> int:
        """Do what the original does until it would exit; return its exit code. Cancelled when everything stops."""
        ...
