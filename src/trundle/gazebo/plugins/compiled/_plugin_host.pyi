"""Compiled plugins of Gazebo, which act before each step of the engine."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.sim.physics import MotorBank, StepAction

class PluginHost(StepAction):
    """Libraries of plugins, and one world as they see it."""

    def __init__(self, functions: Sequence[int], name: str, world: bytes) -> None:
        """Create without models.

        Args:
            functions: addresses of mj_kinematics, mj_comPos, mj_comVel, mj_contactForce and mj_rnePostConstraint.
            name: world's name.
            world: its elements.
        """

    def bind(
        self,
        model: int,
        data: int,
        bank: MotorBank,
        links: Sequence[tuple[str, int]],
        joints: Sequence[
            tuple[str, Sequence[tuple[int, int, int, float, bool]], int, tuple[float, float, float], float]
        ],
        collisions: Sequence[str],
    ) -> None:
        """Use these arrays from now on.

        Args:
            model: address of the mjModel.
            data: address of the mjData.
            bank: motors.
            links: `model::link` and its body.
            joints: `model::joint`, its axes (index, addresses in qpos and qvel, sign, whether it can be driven), and
                the link that moves with it, −1 for none, with its place there [m] and −1 if that is its parent.
            collisions: `model::link::collision` of each geom.
        """

    def add_model(self, name: str, elements: bytes) -> None:
        """Add a model."""

    def remove_model(self, name: str) -> None:
        """Remove a model with its plugins."""

    def open(self, file: str) -> int:
        """Open a library and return its handle.

        Raises:
            RuntimeError: it cannot be opened.
        """

    @staticmethod
    def start_ros(library: int, master_uri: str, node: str) -> None:
        """Make this process a node of roscpp, if the library uses it."""

    def load(self, library: int, parent: str, name: str, file: str, elements: bytes) -> int:
        """Load a plugin of an opened library, and return its number.

        Raises:
            RuntimeError: it was not loaded; the text says why.
        """

    def reset(self, plugin: int) -> None:
        """Call a plugin's Reset; 0: clear the commands of all."""

    def wants_reading(self, plugin: int) -> bool:
        """Return whether anybody wants readings of a sensor's plugin."""

    def take_reading(
        self,
        plugin: int,
        time_ns: int,
        values: NDArray[np.float64],
        image: NDArray[np.uint8] | None,
        depths: NDArray[np.float32] | None,
        contacts: Sequence[tuple[str, str, Sequence[float]]],
    ) -> None:
        """Give a sensor's plugin a reading.

        Args:
            plugin: number of the plugin.
            time_ns: time of the reading [ns].
            values: (N,) numbers of the sensor's kind; see `trundle_host.h`.
            image: (height, width, 3) colors of a camera.
            depths: (height, width) depths [m]; NaN where nothing is in reach.
            contacts: both collisions as `model::link::collision`, and position, normal into the first, force on the
                first and depth of each point: ten numbers.
        """

    def close(self) -> None:
        """Destroy all plugins."""

    def begin_stride(self) -> None:
        """Act again at times that it has acted at."""

    def finish_stride(self) -> None:
        """Put back what moved in steps without physics."""

    def act(self, time_ns: int, step_ns: int) -> bool:
        """Act before a step; return False if there are requests or warnings."""

    def take_requests(self) -> list[tuple[list[str], list[float]]]:
        """Return and clear what plugins asked for."""

    def take_warnings(self) -> list[str]:
        """Return and clear what is to be reported."""

    def take_changes(self) -> tuple[bool, bool]:
        """Return whether the state was written, and whether links were moved, since the last call."""

    def checkpoint(self) -> Callable[[], None]:
        """Return a function after which repeated steps are not acted on again."""
