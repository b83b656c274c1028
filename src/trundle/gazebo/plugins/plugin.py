"""Base classes of plugins: Python counterparts of Gazebo's ModelPlugin, VisualPlugin and WorldPlugin.

Write a class like this in `rp2w.py` beside `model.sdf`, name `librp2w.so` (or `rp2w.py`) in the model's
<plugin filename="…">, and `trundle run` loads it:

    from trundle.robots.parameters import TagParameters
    from trundle.gazebo.plugins import Plugin

    class Spinner(Plugin):
        period_ns = 10_000_000  # called every 10 ms of simulation time

        @classmethod
        def load(cls, sim, model, node, tag):
            spinner = cls()
            parameters = TagParameters(tag.node, sim.report)
            spinner.joint = model.joint(parameters.text("joint", "wheel"))
            return spinner

        def before_step(self, sim):
            self.joint.command_effort(0.5)
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Self, TypeVar

from trundle.robots.model import PluginTag, Visual

if TYPE_CHECKING:  # a run without ROS starts without its modules, and a check without the engine
    from trundle.ros import Node
    from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation, Snapshot


_Method = TypeVar("_Method", bound=Callable[..., None])


def _does_nothing(method: _Method) -> _Method:
    """Mark a method that the simulation calls only if a plugin overrides it."""
    method.__dict__["does_nothing"] = True
    return method


class Hooks:
    """Hooks of all plugins; they run on the simulation's thread."""

    period_ns: int = 0
    """Period of the two hooks in simulation time [ns]; 0: every physics step, as in Gazebo."""

    @_does_nothing
    def before_step(self, sim: "Simulation") -> None:
        """Write efforts, speeds and wrenches; called when due, before the physics step."""

    @_does_nothing
    def after_step(self, snapshot: "Snapshot") -> None:
        """Read the state and publish; called when due, after the physics step."""

    def is_active(self) -> bool:
        """True if the two hooks have work to do; otherwise they are not called, and cost nothing."""
        return True

    def reset(self) -> None:
        """Clear commands and integrals; called when the simulation, or its model alone, is reset."""


class Plugin(Hooks):
    """Plugin of a model: the Python counterpart of a Gazebo ModelPlugin."""

    __module__ = "trundle"

    @classmethod
    def load(cls, sim: "Simulation", model: "ModelHandle", node: "Node | None", tag: PluginTag) -> Self:
        """Make the plugin for one model.

        Args:
            sim: the running simulation.
            model: model with the <plugin> element.
            node: advertises and subscribes; callbacks run between steps. None under `--no-ros`.
            tag: the <plugin> element; `TagParameters(tag.node, sim.report)` reads its parameters.
        """
        raise NotImplementedError(f"{cls.__name__} needs a load(cls, sim, model, node, tag)")


class VisualPlugin(Hooks):
    """Plugin of a visual: the Python counterpart of a Gazebo VisualPlugin."""

    __module__ = "trundle"

    @classmethod
    def load(
        cls,
        sim: "Simulation",
        model: "ModelHandle",
        link: "LinkHandle",
        visual: Visual,
        node: "Node | None",
        tag: PluginTag,
    ) -> Self:
        """Make the plugin for one visual of a link; see `Plugin.load`."""
        raise NotImplementedError(f"{cls.__name__} needs a load(cls, sim, model, link, visual, node, tag)")


class WorldPlugin(Hooks):
    """Plugin of a world: the Python counterpart of a Gazebo WorldPlugin."""

    __module__ = "trundle"

    @classmethod
    def load(cls, sim: "Simulation", node: "Node | None", tag: PluginTag) -> Self:
        """Make the plugin for the world; see `Plugin.load`."""
        raise NotImplementedError(f"{cls.__name__} needs a load(cls, sim, node, tag)")
