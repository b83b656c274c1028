"""Reader of <world>, and of files with models and lights only."""

from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Light, Model, World

from .context import Context, read_pose, warn_ignored
from .environment import read_atmosphere, read_physics, read_scene, read_spherical_coordinates
from .frames import WORLD, FrameGraph
from .include import open_include, read_included_model
from .light import read_light
from .merge import MergedModel, merge_model
from .model import JointElement, read_frames, read_model
from .population import read_population
from .road import read_road
from .sensor import read_plugin
from .state import apply_state, inserted
from .unplaced_model import UnplacedModel

if TYPE_CHECKING:
    from trundle.robots.model import Actor


def read_root(root: XmlNode, context: Context) -> tuple[World, bool]:
    """Read everything under <sdf>; return it as a world, and True if the file has a <world>.

    Raises:
        DescriptionError: the file is empty, or a part of it cannot be interpreted.
    """
    worlds = root.all("world")
    version = str(context.version)
    if worlds:
        if len(worlds) > 1:
            context.report.warn(worlds[1].at, "a second <world>; only the first is simulated", "second-world")
        return replace(read_world(worlds[0], context), sdf_version=version), True
    contents = _Contents(root, context)
    actors = _actors(root, context)
    root.report_unread(context.report)
    if not contents.parts and not contents.lights and not root.children:
        raise DescriptionError(root.at, f"<{root.tag}> contains no world, model or light", "nothing-to-simulate")
    models = contents.models()
    named = (*models, *contents.lights, *actors)
    name = named[0].name if named else ""
    lights = tuple(contents.lights)
    return World(name=name, at=root.at, models=models, lights=lights, actors=actors, sdf_version=version), False


def read_world(node: XmlNode, context: Context) -> World:
    """Read one <world>."""
    report = context.report
    default = World(name=node.attribute("name") or "default", at=node.at)
    name = default.name
    contents = _Contents(node, context)
    for child in inserted(node):
        contents.add(child)
    frames = read_frames(node, contents.graph, context)
    joints = [j for child in node.all("joint") if (j := JointElement(child, contents.graph, context)).is_sound]
    for joint in joints:
        joint.add_to(contents.graph)
    wind = node.find("wind")
    whole = Model(
        name=name,
        at=node.at,
        models=contents.models(),
        joints=tuple(joint.read(contents.graph, context) for joint in joints),
        frames=tuple(replace(frame, model_from_frame=contents.graph.pose(frame.name)) for frame in frames),
        plugins=tuple(read_plugin(tag) for tag in node.all("plugin")),
    )
    for merged_model in contents.merged:
        whole = merged_model.merge_into(whole, contents.graph)
    physics, *other_physics = read_physics(node, context)
    models, lights = apply_state(node, name, whole.models, contents.lights, context)
    world = World(
        name=name,
        at=node.at,
        models=models,
        joints=whole.joints,
        frames=whole.frames,
        lights=lights,
        roads=tuple(road for child in node.all("road") if (road := read_road(child, context)) is not None),
        actors=_actors(node, context),
        plugins=whole.plugins,
        physics=physics,
        other_physics=tuple(other_physics),
        scene=read_scene(node, context),
        spherical_coordinates=read_spherical_coordinates(node, context),
        atmosphere=read_atmosphere(node, context),
        magnetic_field=node.vector("magnetic_field", default=default.magnetic_field),
        wind=default.wind if wind is None else wind.vector("linear_velocity", default=default.wind),
    )
    warn_ignored(node, ("gui", "audio"), "is for Gazebo's own window", context)
    node.report_unread(report)
    return world


def _actors(node: XmlNode, context: Context) -> "tuple[Actor, ...]":
    nodes = node.all("actor")
    if not nodes:
        return ()
    from .actor import read_actor  # loaded only for worlds with actors

    return tuple(read_actor(child, context) for child in nodes)


class _Contents:
    """Models and lights of a world or root element, included ones in file order."""

    def __init__(self, node: XmlNode, context: Context) -> None:
        self.graph = FrameGraph(WORLD, context.report)
        self.parts: list[UnplacedModel] = []
        self.lights: list[Light] = []
        self.merged: list[MergedModel] = []
        """Models to be merged into the world."""
        self._context = context
        for child in node.children:
            self.add(child)
        for tag in ("model", "include", "light", "population"):
            node.all(tag)

    def add(self, child: XmlNode) -> None:
        """Add the model or light of an element, if any."""
        match child.tag:
            case "model":
                self._add(read_model(child, self._context))
            case "include":
                self._include(child)
            case "light":
                self.lights.append(read_light(child, WORLD, self.graph, self._context))
            case "population":
                for part in read_population(child, read_model, self._context):
                    self._add(part)
            case _:
                pass

    def models(self) -> tuple[Model, ...]:
        """Return every model with its pose."""
        return tuple(replace(part.model, world_from_model=self.graph.pose(part.model.name)) for part in self.parts)

    def _include(self, node: XmlNode) -> None:
        opened = open_include(node, self._context)
        if opened is None:
            node.mark_all_read()
            return
        root, inner = opened
        part = read_included_model(node, root, inner, self._context, read_model)
        if part is not None:
            if part.merge and self._can_merge(part, node):
                self.merged.append(merge_model(part, self.graph))
            else:
                self._add(part)
            return
        name = node.string("name")
        for light in (read_light(child, WORLD, self.graph, inner) for child in root.all("light")):
            has_pose = node.find("pose") is not None
            pose = self.graph.pose_in(WORLD, read_pose(node, self._context), node.at)
            self.lights.append(
                replace(
                    light,
                    name=name or light.name,
                    world_from_light=pose if has_pose else light.world_from_light,
                )
            )

    def _can_merge(self, part: UnplacedModel, node: XmlNode) -> bool:
        """True if a model can be merged into the world: it has no links, and its model names are free."""
        duplicates = [inner.name for inner in part.model.models if inner.name in self.graph]
        reason = ""
        if part.model.links:
            reason = "links of its own, which a world cannot have"
        elif duplicates:
            reason = f"a model {duplicates[0]!r}, whose name is taken"
        if reason:
            self._context.report.warn(
                node.at, f"model {part.model.name!r} has {reason}; it is not merged", "not-merged"
            )
        return not reason

    def _add(self, part: UnplacedModel) -> None:
        """Add a model; a duplicate name gets a number, as in Gazebo."""
        name, number = part.model.name, 0
        while name in self.graph:
            name = f"{part.model.name}_{number}"
            number += 1
        if name != part.model.name:
            self._context.report.warn(
                part.model.at, f"a second model {part.model.name!r}; it is renamed {name!r}", "duplicate-name"
            )
            part = replace(part, model=replace(part.model, name=name))
        part.add_to(self.graph)
        self.parts.append(part)
