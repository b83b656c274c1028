"""Loads the plugins that the models of a world ask for."""

from collections.abc import Callable, Mapping

from trundle.diagnostics import DescriptionError
from trundle.names import ros_name
from trundle.plugins import Plugin, find_plugin
from trundle.ros import Node
from trundle.simulation import Simulation


def load_plugins(
    simulation: Simulation,
    make_node: Callable[[str], Node] | None,
    environment: Mapping[str, str],
    *,
    say: Callable[[str], None],
) -> list[Plugin]:
    """Load each plugin and hook it in; one that cannot be had is named, and the run goes on as in Gazebo."""
    report = simulation.report
    loaded: list[Plugin] = []
    for model in simulation.world.models:
        for tag in model.plugins:
            try:
                plugin_class, origin = find_plugin(tag, environment)
            except DescriptionError as error:
                report.warn(error.at, f"{error.what}; the run goes on without it")
                continue
            say(f"plugin {tag.name!r} of {model.name}: {origin}")
            node = None if make_node is None else make_node(f"/{ros_name(model.name)}/{ros_name(tag.name)}")
            try:
                plugin = plugin_class.load(simulation, simulation[model.name], node, tag)
            except Exception as error:
                report.warn(tag.at, f"plugin {tag.name!r}: {type(error).__name__}: {error}; the run goes on without it")
                continue
            simulation.add_hook(plugin, period_ns=plugin.period_ns)
            simulation.on_reset(plugin.reset)
            loaded.append(plugin)
    for tag in simulation.world.plugins:
        report.warn(tag.at, f"world plugin {tag.name!r} ({tag.filename}) is not supported; the run goes on without it")
    return loaded
