"""Loads the plugins that the models of a world ask for."""

from collections.abc import Callable, Mapping, Sequence

from trundle.diagnostics import DescriptionError
from trundle.names import ros_name
from trundle.plugins import Plugin, find_plugin
from trundle.ros import Node
from trundle.simulation import ModelHandle, Simulation


def load_plugins(
    simulation: Simulation,
    make_node: Callable[[str], Node] | None,
    environment: Mapping[str, str],
    *,
    say: Callable[[str], None],
    models: Sequence[ModelHandle] | None = None,
) -> list[Plugin]:
    """Load each plugin and hook it in; one that cannot be had is named, and the run goes on as in Gazebo.

    Args:
        simulation: what they act on.
        make_node: makes a node for each; None: without ROS.
        environment: says where plugins are.
        say: is told what is loaded.
        models: whose plugins; None: those of every model, and what the world itself asks for is named.
    """
    report = simulation.report
    loaded: list[Plugin] = []
    for handle in simulation.models if models is None else models:
        model = handle.model
        for tag in model.plugins:
            try:
                plugin_class, origin = find_plugin(tag, environment)
            except DescriptionError as error:
                report.warn(error.at, f"{error.what}; the run goes on without it")
                continue
            say(f"plugin {tag.name!r} of {model.name}: {origin}")
            node = None if make_node is None else make_node(f"/{ros_name(model.name)}/{ros_name(tag.name)}")
            try:
                plugin = plugin_class.load(simulation, handle, node, tag)
            except Exception as error:
                report.warn(tag.at, f"plugin {tag.name!r}: {type(error).__name__}: {error}; the run goes on without it")
                continue
            _hook_in(simulation, handle, plugin)
            loaded.append(plugin)
    for tag in simulation.world.plugins if models is None else ():
        report.warn(tag.at, f"world plugin {tag.name!r} ({tag.filename}) is not supported; the run goes on without it")
    return loaded


def _hook_in(simulation: Simulation, model: ModelHandle, plugin: Plugin) -> None:
    """Have the plugin called as long as its model is there."""

    def is_there() -> bool:
        return any(handle is model for handle in simulation.models)

    def reset() -> None:
        if is_there():
            plugin.reset()

    simulation.add_hook(plugin, period_ns=plugin.period_ns, wanted=is_there)
    simulation.on_reset(reset)
