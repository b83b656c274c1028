"""Base class of users' layers in Python."""

from abc import ABC, abstractmethod
from typing import final

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ..plugin_classes import describe
from .costmap import Bounds, Costmap


class LayerOptions(msgspec.Struct):
    """Parameters of a layer that dynamic_reconfigure changes."""

    enabled: bool = True


class LayerPlugin(ABC):
    """Base of a layer: subclasses write costs. An exception in one switches it off until the costmap is cleared."""

    def __init__(
        self, node: Node, name: str, settings: RosParameters, master: Costmap, buffer: TransformBuffer, frame: str
    ) -> None:
        """Keep what the layer needs; a subclass that subscribes or reads parameters calls this first."""
        self.node = node
        """Node of move_base: its topics, services, log and clock."""
        self.name = name
        self.settings = settings
        """Parameters of the layer."""
        self.master = master
        """The costmap, whose size and place may change."""
        self.buffer = buffer
        """Transforms."""
        self.frame = frame
        """Frame of the costmap."""
        self.options = LayerOptions(settings.flag("enabled", default=True))
        self._is_wanted = self.options.enabled

    @abstractmethod
    def add_costs(self, costs: NDArray[np.uint8], window: tuple[int, int, int, int]) -> None:
        """Change the costs (height, width) of the whole costmap in place, within the window x0, y0, x1, y1 of cells.

        It is called at each update of the costmap, on the graph's thread.
        """

    def changed_bounds(self, robot: tuple[float, float, float]) -> Bounds | None:
        """Return where costs will change [m], with the robot at x, y [m], yaw [rad]; None: anywhere."""
        del robot
        return None

    def reset(self) -> None:
        """Take part again after an exception; subclasses that keep observations discard them, too."""
        self.options.enabled = self._is_wanted

    @property
    def is_current(self) -> bool:
        """True if the layer's data are recent enough to drive; subclasses may replace it."""
        return True

    @final
    @property
    def enabled(self) -> bool:
        """See `Layer`."""
        return self.options.enabled

    def change(self) -> None:
        """See `Layer`."""
        self._is_wanted = self.options.enabled

    def match_size(self) -> None:
        """Allocate the layer again for a costmap of another size."""
        self.reset()

    @final
    def update_bounds(self, robot: tuple[float, float, float], bounds: Bounds) -> None:
        """See `Layer`."""
        try:
            own = self.changed_bounds(robot)
        except Exception as error:
            self._fail(error)
            return
        if own is None:
            bounds.touch_all(self.master)
        else:
            bounds.join(own)

    @final
    def update_costs(self, master: Costmap, window: tuple[int, int, int, int]) -> None:
        """See `Layer`."""
        try:
            self.add_costs(master.cells, window)
        except Exception as error:
            self._fail(error)

    def _fail(self, error: Exception) -> None:
        self.node.log.error(f"layer {self.name} is switched off: {describe(error)}")
        self.options.enabled = False
