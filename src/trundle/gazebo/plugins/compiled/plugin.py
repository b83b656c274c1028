"""Compiled plugins as the simulation handles all plugins: by their tag."""

from pathlib import Path
from typing import TYPE_CHECKING, Self

from trundle.robots.model import PluginTag, Visual

from ..plugin import Plugin, VisualPlugin, WorldPlugin
from .plugin_world import CompiledPlugins

if TYPE_CHECKING:
    from trundle.ros import Node
    from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation


def compiled_model_plugin(library: Path) -> type[Plugin]:
    """Return the class that loads a model's plugin from a library."""

    class CompiledModelPlugin(Plugin):
        """Plugin of a model in C++; what it does before each step is called by `CompiledPlugins`."""

        def __init__(self, plugins: CompiledPlugins, number: int) -> None:
            self._plugins, self._number = plugins, number

        @classmethod
        def load(cls, sim: "Simulation", model: "ModelHandle", node: "Node | None", tag: PluginTag) -> Self:
            """See `Plugin.load`."""
            plugins = CompiledPlugins.of(sim)
            return cls(plugins, plugins.load(library, tag, model.name, node))

        def reset(self) -> None:
            """Call the plugin's Reset."""
            self._plugins.reset(self._number)

    return CompiledModelPlugin


def compiled_visual_plugin(library: Path) -> type[VisualPlugin]:
    """Return the class that loads a visual's plugin from a library."""

    class CompiledVisualPlugin(VisualPlugin):
        """Plugin of a visual in C++."""

        def __init__(self, plugins: CompiledPlugins, number: int) -> None:
            self._plugins, self._number = plugins, number

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
            """See `VisualPlugin.load`."""
            plugins = CompiledPlugins.of(sim)
            return cls(plugins, plugins.load(library, tag, f"{model.name}::{link.name}::{visual.name}", node))

        def reset(self) -> None:
            """Call the plugin's Reset."""
            self._plugins.reset(self._number)

    return CompiledVisualPlugin


def compiled_world_plugin(library: Path) -> type[WorldPlugin]:
    """Return the class that loads a world's plugin from a library."""

    class CompiledWorldPlugin(WorldPlugin):
        """Plugin of a world in C++."""

        def __init__(self, plugins: CompiledPlugins, number: int) -> None:
            self._plugins, self._number = plugins, number

        @classmethod
        def load(cls, sim: "Simulation", node: "Node | None", tag: PluginTag) -> Self:
            """See `WorldPlugin.load`."""
            plugins = CompiledPlugins.of(sim)
            return cls(plugins, plugins.load(library, tag, sim.world.name, node))

        def reset(self) -> None:
            """Call the plugin's Reset."""
            self._plugins.reset(self._number)

    return CompiledWorldPlugin
