"""Reads <world>, and a model or light that stands alone in a file."""

from dataclasses import replace
from pathlib import Path

from trundle.diagnostics import DescriptionError, UsageError
from trundle.model import Light, Model, PhysicsSettings, SceneSettings, World
from trundle.packages import model_file
from trundle.spatial import normalized
from trundle.xmlnode import XmlNode, read_xml

from .context import Context, read_pose
from .material import read_colour
from .model import read_model
from .sensor import read_plugin
from .version import read_version

_DEEPEST_INCLUDE = 16
_FOR_THE_EYE = ("gui", "audio", "atmosphere", "magnetic_field", "wind", "spherical_coordinates")


def read_root(root: XmlNode, context: Context) -> tuple[World, bool]:
    """Read everything under <sdf>; return it as a world, and whether the file has a <world> of its own."""
    worlds = root.all("world")
    if worlds:
        if len(worlds) > 1:
            context.report.warn(worlds[1].at, "a second <world>; only the first is simulated")
        return replace(read_world(worlds[0], context), sdf_version=str(context.version)), True
    models, lights = _contents(root, context)
    root.report_unread(context.report)
    if not models and not lights:
        raise DescriptionError(root.at, f"<{root.tag}> holds no world, model or light")
    name = models[0].name if models else lights[0].name
    world = World(name=name, at=root.at, models=models, lights=lights, sdf_version=str(context.version))
    return world, False


def read_world(node: XmlNode, context: Context) -> World:
    """Read one <world>."""
    models, lights = _contents(node, context)
    scene = node.find("scene")
    world = World(
        name=node.attribute("name") or "default",
        at=node.at,
        models=models,
        lights=lights,
        plugins=tuple(read_plugin(tag) for tag in node.all("plugin")),
        physics=_read_physics(node, context),
    )
    if scene is not None:
        background = read_colour(scene, "background", world.scene.background, context)
        world = replace(world, scene=SceneSettings(background=background))
        for tag in ("ambient", "shadows", "grid", "sky", "origin_visual", "fog"):
            scene.find(tag)
        scene.report_unread(context.report)
    for tag in _FOR_THE_EYE:
        element = node.find(tag)
        if element is not None:
            context.report.info(element.at, f"<{tag}> is read by nothing yet")
    node.report_unread(context.report)
    return world


def _contents(node: XmlNode, context: Context) -> tuple[tuple[Model, ...], tuple[Light, ...]]:
    """Models and lights, included ones in their place; two of one name are told apart by a number, as in Gazebo."""
    models: list[Model] = []
    lights = [_read_light(child, context) for child in node.all("light")]
    for child in node.children:
        if child.tag == "model":
            models.append(read_model(child, context))
        elif child.tag == "include":
            included, lit = _include(child, context)
            models += included
            lights += lit
    node.all("model")
    node.all("include")
    taken: set[str] = set()
    for i, model in enumerate(models):
        name, number = model.name, 0
        while name in taken:
            name = f"{model.name}_{number}"
            number += 1
        if name != model.name:
            context.report.warn(model.at, f"a second model {model.name!r}; it is called {name!r}")
            models[i] = replace(model, name=name)
        taken.add(name)
    return tuple(models), tuple(lights)


def _include(node: XmlNode, context: Context) -> tuple[list[Model], list[Light]]:
    """What an <include> brings in; one that leads nowhere is named and left out, as Gazebo does."""
    report = context.report
    uri = node.string("uri")
    if not uri:
        report.warn(node.at, "<include> without <uri>; it is left out")
        return [], []
    try:
        path = context.packages.resolve(uri, beside=context.folder, at=node.at)
        file = model_file(path, report) if path.is_dir() else path
        included = _read_included(file, node, context)
    except (DescriptionError, UsageError) as error:
        at = error.at if isinstance(error, DescriptionError) else node.at
        what = error.what if isinstance(error, DescriptionError) else str(error)
        report.warn(at, f"{what}; what was to be included at line {node.at.line} is left out")
        return [], []
    name, static = node.string("name"), node.find("static")
    pose = read_pose(node, context).pose if node.find("pose") is not None else None
    plugins = tuple(read_plugin(tag) for tag in node.all("plugin"))
    models = [
        replace(
            model,
            name=name or model.name,
            world_from_model=model.world_from_model if pose is None else pose,
            static=model.static if static is None else static.as_flag(default=False, report=report),
            plugins=(*model.plugins, *plugins),
        )
        for model in included.models
    ]
    lights = [
        replace(light, name=name or light.name, world_from_light=light.world_from_light if pose is None else pose)
        for light in included.lights
    ]
    node.report_unread(report)
    return models, lights


def _read_included(file: Path, node: XmlNode, context: Context) -> World:
    if file in context.including or len(context.including) > _DEEPEST_INCLUDE:
        raise DescriptionError(node.at, f"{file} includes itself")
    root = read_xml(file)
    inner = context.inside(file, read_version(root, context.report))
    return read_root(root, inner)[0]


def _read_light(node: XmlNode, context: Context) -> Light:
    default = Light(name="", type="", at=node.at)
    direction = normalized(node.vector("direction", default=default.direction, report=context.report))
    light = Light(
        name=node.attribute("name") or "light",
        type=node.attribute("type") or "point",
        at=node.at,
        world_from_light=read_pose(node, context).pose,
        direction=direction or default.direction,
        diffuse=read_colour(node, "diffuse", default.diffuse, context),
        specular=read_colour(node, "specular", default.specular, context),
        cast_shadows=node.flag("cast_shadows", default=False, report=context.report),
    )
    node.find("attenuation")
    node.find("spot")
    node.report_unread(context.report)
    return light


def _read_physics(world: XmlNode, context: Context) -> PhysicsSettings:
    report = context.report
    default = PhysicsSettings()
    profiles = world.all("physics")
    node = next((p for p in profiles if (p.attribute("default") or "") in ("1", "true")), None)
    node = node or (profiles[0] if profiles else None)
    gravity_home = node if context.version < (1, 6) and node is not None and node.find("gravity") else world
    gravity = gravity_home.vector("gravity", default=default.gravity, report=report)
    if node is None:
        return PhysicsSettings(gravity=gravity)
    step = node.number("max_step_size", default=default.max_step_size_s, report=report)
    if not 1e-6 <= step <= 1.0:
        report.warn(node.at, f"a step of {step:g} s is not possible; {default.max_step_size_s:g} is used")
        step = default.max_step_size_s
    rate = node.number("real_time_update_rate", default=default.real_time_update_rate_hz, report=report)
    for tag in ("real_time_factor", "max_contacts"):
        node.find(tag)
    for engine in ("ode", "bullet", "simbody", "dart"):
        if node.find(engine) is not None:
            report.info(node.at, f"<{engine}>: the engine here is MuJoCo, with settings of its own")
    node.attributes()
    node.report_unread(report)
    return PhysicsSettings(max_step_size_s=step, real_time_update_rate_hz=rate, gravity=gravity)
