"""Interfaces between built-in nodes and the program that hosts them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from trundle.base.supervisor import ProcessTree, Terminal
from trundle.ros import Node
from trundle.spatial import Pose

if TYPE_CHECKING:
    from trundle.sim.sensors import CameraSensor, InstrumentSensor
    from trundle.sim.simulation import Simulation


@dataclass(frozen=True, slots=True, kw_only=True)
class Slider:
    """A joint slider; limits are finite [rad] or [m]."""

    name: str
    lower: float
    upper: float
    position: float


class Display(Protocol):
    """Web page of the graph; one per launch, shared by all rviz nodes."""

    def offer_sliders(self, sliders: Sequence[Slider], move: Callable[[str, float], None]) -> None:
        """Show joint sliders; `move` is called with a joint's name and position, on any thread."""
        ...

    def drive_on(self, topic: str) -> None:
        """Connect the page's joystick pad to a velocity topic; the first call wins."""
        ...

    def show_image(self, topic: str) -> None:
        """Show an image topic, besides those of an rviz configuration."""
        ...

    def open_panel(self, program: str) -> None:
        """Open the panel that replaces a program, such as `rqt_graph`."""
        ...

    def plot(self, fields: Sequence[str]) -> None:
        """Plot message fields `/topic/field/…` over time, as rqt_plot does."""
        ...

    def offer_joystick(self, move: Callable[[Sequence[float], Sequence[int]], None]) -> None:
        """Offer the page's joystick or a gamepad; `move` is called with axes and buttons as in sensor_msgs/Joy."""
        ...

    async def show(self, node: Node, *, config: str | None, fixed_frame: str | None) -> int:
        """Show until the page is closed or the call is cancelled; returns an exit code.

        Args:
            node: the rviz node, for subscriptions and publications of its displays and tools.
            config: path of an .rviz file, which may not exist.
            fixed_frame: overrides the fixed frame of `config`.
        """
        ...


class Simulator(Protocol):
    """The simulation of a launch, on its own thread.

    All methods but `open`, `begin`, `close`, `post` and `show` must be called on that thread.
    """

    @property
    def simulation(self) -> "Simulation":
        """The running world."""
        ...

    @property
    def sensors(self) -> "Sequence[CameraSensor | InstrumentSensor]":
        """All sensors of the world."""
        ...

    @property
    def paused(self) -> bool: ...

    @property
    def is_lockstep(self) -> bool:
        """True if sim time waits for nodes, as at maximum speed; nodes then use only sim time, for repeatability."""
        ...

    async def open(
        self,
        node: Node,
        world: str,
        *,
        paused: bool,
        env: Mapping[str, str],
        record: str | None = None,
        server_plugins: Sequence[str] = (),
    ) -> None:
        """Load a world, with time paused until `begin`.

        Args:
            node: publishes /clock; its callbacks run on the simulation's thread.
            world: path, or name searched in Gazebo's resource path.
            paused: True: start paused.
            env: additional environment, such as GAZEBO_MODEL_PATH.
            record: folder of state logs, "" for the default; None: no logs.
            server_plugins: libraries of plugins of the system.

        Raises:
            TrundleError: the world is missing or invalid, or another one is open.
        """
        ...

    def begin(self) -> None:
        """Start time, after all services are registered; thread-safe."""
        ...

    def close(self) -> None:
        """Stop the simulation and join its thread; must not be called on that thread or on the graph's loop."""
        ...

    def post(self, call: Callable[[], object]) -> None:
        """Call a function between steps, even while paused; thread-safe."""
        ...

    def set_paused(self, paused: bool) -> None: ...

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add a model from SDF or URDF text.

        Raises:
            TrundleError: the name exists, or the text is invalid.
        """
        ...

    def delete(self, name: str) -> None:
        """Remove a model.

        Raises:
            TrundleError: the model does not exist.
        """
        ...

    def do(self, command: "Callable[[Simulation], object]") -> None:
        """Run a command on the simulation; its timeline repeats the command.

        Raises:
            TrundleError: raised by the command.
        """
        ...

    def set_speed(self, speed: float | None) -> None:
        """Set the target real-time factor; None: as fast as possible."""
        ...

    def reset(self, *, time: bool) -> None:
        """Reset all models to their initial poses; with `time`, also sim time to zero."""
        ...

    async def show(self, node: Node) -> int:
        """Show the world's window until cancelled; returns an exit code."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeHost:
    """Services of the host program for built-in nodes."""

    display: Display | None = None
    """None if headless; rviz then idles."""
    simulator: Simulator | None = None
    """None if simulation is not available."""
    env: Mapping[str, str] = field(default_factory=dict[str, str])
    """Environment set by the launch file for this node."""
    terminal: Terminal | None = None
    """Terminal of the node; None: terminal of this process."""
    tree: ProcessTree = field(default_factory=ProcessTree)
    """Tree of the node's child processes, which end with the node."""


class BuiltinNode(Protocol):
    """A node that runs in this process and replaces a stock executable.

    Created on the graph's loop with `(node, arguments, host)`: `arguments` is the command line without program and ROS
    arguments. Time is read and awaited through `node.clock` only.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None: ...

    async def run(self) -> int:
        """Run like the original until it would exit; returns its exit code. Cancelled at shutdown."""
        ...
