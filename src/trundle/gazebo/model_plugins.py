"""Loader of the plugins of a world, its models, visuals and sensors."""

from collections.abc import Callable, Mapping, Sequence
from itertools import chain, count
from pathlib import Path, PurePosixPath
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeVar

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, TrundleError
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.plugins import (
    Hooks,
    Plugin,
    VisualPlugin,
    find_model_sensor_plugin,
    find_plugin,
    find_sensor_plugin,
    find_visual_plugin,
    find_world_plugin,
    is_cosmetic,
    is_sensor_plugin,
    plugin_library,
    require_plugin,
)
from trundle.robots.model import PluginTag, Visual, World
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters

if TYPE_CHECKING:  # a run without ROS or sensors starts without their modules, and a check without the engine
    from trundle.ros import Node
    from trundle.sim.sensors import CameraSensor, InstrumentSensor
    from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation

_Kind = TypeVar("_Kind")
_FALLBACK = "the sensor has topics without"


def load_plugins(
    simulation: "Simulation",
    make_node: "Callable[[str], Node] | None",
    environment: Mapping[str, str],
    *,
    log: Callable[[str], None],
    models: "Sequence[ModelHandle] | None" = None,
) -> list[Plugin]:
    """Load the models' plugins and add their hooks; warn of plugins that fail to load and go on, as Gazebo does.

    Args:
        simulation: running simulation.
        make_node: creates a plugin's node from its name; None: without ROS.
        environment: variables that locate plugins.
        log: prints the origin of each plugin.
        models: models whose plugins are loaded; None: all.
    """
    loaded: list[Plugin] = []
    for model in simulation.models if models is None else models:
        for tag, node_name in _unique_node_names(f"/{ros_name(model.name)}", model.model.plugins):

            def load(tag: PluginTag = tag, model: "ModelHandle" = model, node_name: str = node_name) -> Plugin:
                plugin_class, origin = find_plugin(tag, environment)
                log(f"plugin {tag.name!r} of {model.name}: {origin}")
                node = None if make_node is None else make_node(node_name)
                return plugin_class.load(simulation, model, node, tag)

            plugin = _load_or_warn(tag, load, simulation.report)
            if plugin is not None:
                _add_hooks(simulation, plugin, model, f"{model.name}::{tag.name}")
                loaded.append(plugin)
        _load_visual_plugins(simulation, model, make_node, environment, log)
    return loaded


def _load_visual_plugins(
    simulation: "Simulation",
    model: "ModelHandle",
    make_node: "Callable[[str], Node] | None",
    environment: Mapping[str, str],
    log: Callable[[str], None],
) -> None:
    """Load the plugins of a model's visuals; see `load_plugins`."""
    report = simulation.report
    for link in model.links:
        tags = [(visual, tag) for visual in link.link.visuals for tag in visual.plugins]
        named_tags = _unique_node_names(f"/{ros_name(model.name)}/{ros_name(link.name)}", [tag for _, tag in tags])
        for (visual, tag), (_, node_name) in zip(tags, named_tags, strict=True):
            if is_cosmetic(tag, environment):
                message = f"plugin {tag.name!r}: {tag.filename} alters only how Gazebo draws a visual; it is not run"
                report.info(tag.at, message, "cosmetic-plugin")
                continue

            def load(
                tag: PluginTag = tag, link: "LinkHandle" = link, visual: Visual = visual, node_name: str = node_name
            ) -> VisualPlugin:
                plugin_class, origin = find_visual_plugin(tag, environment)
                log(f"plugin {tag.name!r} of {model.name}::{link.name}::{visual.name}: {origin}")
                node = None if make_node is None else make_node(node_name)
                return plugin_class.load(simulation, model, link, visual, node, tag)

            plugin = _load_or_warn(tag, load, report)
            if plugin is not None:
                _add_hooks(simulation, plugin, model, f"{model.name}::{link.name}::{visual.name}::{tag.name}")


def load_world_plugins(
    simulation: "Simulation",
    make_node: "Callable[[str], Node] | None",
    environment: Mapping[str, str],
    *,
    log: Callable[[str], None],
) -> None:
    """Load the plugins of the world itself; see `load_plugins`."""
    world = simulation.world
    for tag, node_name in _unique_node_names(f"/{ros_name(world.name)}", world.plugins):

        def load(tag: PluginTag = tag, node_name: str = node_name) -> Hooks:
            plugin_class, origin = find_world_plugin(tag, environment)
            log(f"plugin {tag.name!r} of the world: {origin}")
            node = None if make_node is None else make_node(node_name)
            return plugin_class.load(simulation, node, tag)

        plugin = _load_or_warn(tag, load, simulation.report)
        if plugin is not None:
            _add_hooks(simulation, plugin, None, tag.name)
    if any(world.wind) and not any(tag.filename.endswith("libWindPlugin.so") for tag in world.plugins):
        report = simulation.report
        report.info(
            world.at,
            "there is no wind force: as in Gazebo, it needs libWindPlugin.so in the world",
            "wind-without-plugin",
        )


def load_server_plugins(
    simulation: "Simulation",
    files: Sequence[str],
    make_node: "Callable[[str], Node] | None",
    environment: Mapping[str, str],
    *,
    log: Callable[[str], None],
) -> None:
    """Load plugins of the system, which `gzserver -s` names by their libraries; see `load_plugins`."""
    for file in files:
        at = Source(f"gzserver -s {file}")
        name = PurePosixPath(file).stem.removeprefix("lib")
        tag = PluginTag(name=name, filename=file, at=at, node=parse_xml("<plugin/>", name=at.file))

        def load(tag: PluginTag = tag) -> Hooks:
            library = plugin_library(tag, environment)
            if library is None:
                raise DescriptionError(
                    tag.at,
                    f"there is no library {tag.filename} that was compiled with Trundle's kit; it is searched here, in "
                    "build, along GAZEBO_PLUGIN_PATH and LD_LIBRARY_PATH, and in devel/lib of the workspace",
                    "compiled-plugin",
                )
            from .plugins.compiled import compiled_world_plugin  # lazy: most worlds have none

            log(f"server plugin {tag.name!r}: {library}, in C++")
            node = None if make_node is None else make_node(f"/{ros_name(tag.name)}")
            return compiled_world_plugin(library).load(simulation, node, tag)

        plugin = _load_or_warn(tag, load, simulation.report)
        if plugin is not None:
            _add_hooks(simulation, plugin, None, tag.name)


_Sensor = TypeVar("_Sensor", "CameraSensor", "InstrumentSensor")


def attach_sensor_plugins(
    sensors: Sequence[_Sensor],
    node: "Node",
    simulation: "Simulation",
    environment: Mapping[str, str] = MappingProxyType({}),
) -> list[_Sensor]:
    """Attach the sensors' plugins, which publish the readings; return the sensors without a plugin, in order.

    Args:
        sensors: a model's sensors.
        node: publishes their readings.
        simulation: the simulation.
        environment: variables that locate compiled plugins.
    """
    from trundle.gazebo.plugins import PluginNames
    from trundle.ros import Publisher

    report, models = simulation.report, [model.model for model in simulation.models]

    silent: list[_Sensor] = []
    compiled: dict[int, bool] = {}
    """Tag → whether its plugin was loaded: cameras of a multicamera share one."""
    for sensor in sensors:
        attached_count = 0
        plugins = [(tag, find_sensor_plugin(tag)) for tag in sensor.sensor.plugins]
        model_plugins = [(tag, find_model_sensor_plugin(tag, sensor.sensor.name)) for tag in sensor.model.plugins]
        for tag, attach in (*plugins, *(pair for pair in model_plugins if pair[1] is not None)):
            library = plugin_library(tag, environment) if tag in sensor.sensor.plugins else None
            if library is not None:
                if id(tag) not in compiled:
                    compiled[id(tag)] = _attach_compiled(library, tag, sensor, node, simulation)
                attached_count += compiled[id(tag)]
                continue
            if attach is None:
                _warn_unsupported(sensor.name, tag, report)
                continue
            try:
                parameters = TagParameters(tag.node, report)
                with node.endpoints.record() as endpoints:
                    attach(sensor, parameters, PluginNames(node, parameters, sensor.model, models))
                sensor.topics |= {
                    endpoint.topic: endpoint.type for endpoint in endpoints if isinstance(endpoint, Publisher)
                }
                attached_count += 1
            except TrundleError as error:
                report.warn_error(error, tag.at, _FALLBACK, "plugin-failed", subject=_sensor_plugin(sensor.name, tag))
        if not attached_count:
            silent.append(sensor)
    return silent


def _attach_compiled(
    library: Path, tag: PluginTag, sensor: "CameraSensor | InstrumentSensor", node: "Node", simulation: "Simulation"
) -> bool:
    """Load a sensor's plugin from a compiled library; return False, with a warning, if it cannot be loaded."""
    from .plugins.compiled import attach_compiled_plugin  # lazy: most robots have none

    try:
        attach_compiled_plugin(library, tag, sensor, node, simulation)
    except TrundleError as error:
        subject = _sensor_plugin(sensor.name, tag)
        simulation.report.warn_error(error, tag.at, _FALLBACK, "plugin-failed", subject=subject)
        return False
    node.log.info(f"plugin {tag.name!r} of {sensor.scoped_name}: {library}, in C++")
    return True


def report_missing_plugins(world: World, environment: Mapping[str, str], report: Diagnostics) -> None:
    """Warn of the plugins that a run would not find, without loading any."""

    def require(tag: PluginTag) -> None:
        _load_or_warn(tag, lambda: require_plugin(tag, environment), report)

    for tag in (*world.plugins, *(tag for model in world.models for tag in model.plugins)):
        require(tag)
    for link in (link for model in world.models for link in model.links):
        for tag in (tag for visual in link.visuals for tag in visual.plugins if not is_cosmetic(tag, environment)):
            require(tag)
        for sensor in link.sensors:
            for tag in (tag for tag in sensor.plugins if not is_sensor_plugin(tag, environment)):
                _warn_unsupported(sensor.name, tag, report)


def _warn_unsupported(sensor: str, tag: PluginTag, report: Diagnostics) -> None:
    report.warn(tag.at, f"{_sensor_plugin(sensor, tag)} is not supported yet; {_FALLBACK}", "sensor-plugin")


def _sensor_plugin(sensor: str, tag: PluginTag) -> str:
    return f"sensor {sensor!r}: plugin {tag.filename}"


def _unique_node_names(namespace: str, tags: Sequence[PluginTag]) -> list[tuple[PluginTag, str]]:
    """Return each plugin with a unique node name: a second node with the same name would shut down the first."""
    names: list[str] = []
    for tag in tags:
        name = f"{namespace}/{ros_name(tag.name)}"
        numbered = (f"{name}_{i}" for i in count(2))
        names.append(next(candidate for candidate in chain([name], numbered) if candidate not in names))
    return list(zip(tags, names, strict=True))


def _load_or_warn(tag: PluginTag, load: Callable[[], _Kind], report: Diagnostics) -> _Kind | None:
    try:
        return load()
    except TrundleError as error:
        subject = "" if isinstance(error, DescriptionError) else f"plugin {tag.name!r}"
        report.warn_error(error, tag.at, "the run goes on without it", "plugin-failed", subject=subject)
    except Exception as error:  # user code may raise anything
        report.warn(
            tag.at, f"plugin {tag.name!r}: {type(error).__name__}: {error}; the run goes on without it", "plugin-failed"
        )
    return None


def _add_hooks(simulation: "Simulation", plugin: Hooks, model: "ModelHandle | None", name: str) -> None:
    """Register a plugin's hooks; they run until its model is deleted."""

    def model_exists() -> bool:
        return model is None or any(handle is model for handle in simulation.models)

    simulation.add_hook(
        plugin, period_ns=plugin.period_ns, enabled=lambda: model_exists() and plugin.is_active(), name=name
    )
    simulation.on_reset(plugin.reset, model=model)
