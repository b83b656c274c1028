"""Editable XML of a world, with the element of each model and light."""

from collections.abc import Iterable
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlDocument, XmlElement
from trundle.robots.model import Light, Model, World
from trundle.spatial import Pose

from ..writing import write_sdf, written_uri
from ..writing.tag import format_value
from .element_edits import put_value, set_frictions, set_inertial, set_light, set_pose
from .new_elements import Elements

_OLDEST_COPIED = (1, 2)
"""Oldest version that is edited in place; SDF 1.0 wrote values as attributes."""


class WorldDocument:
    """Editable XML of a world."""

    def __init__(self, document: XmlDocument, source: Path, elements: Elements) -> None:
        """Index the parts of a document with a <world>.

        Args:
            document: document to edit.
            source: its original file, the base of its relative URIs.
            elements: factory of new elements.
        """
        world = document.root.find("world")
        assert world is not None, "a document of a world has a <world>"
        self._document, self._world, self._elements = document, world, elements
        self._parts: dict[tuple[str, str], XmlElement] = {}
        """(tag, name) → element, which may be an <include>."""
        self._multiple: list[XmlElement] = []
        """Elements that create several models, or merge a model into the world."""
        self._displaced: dict[str, Model] = {}
        """Models with links away from their pose at zero joint positions."""
        self._dissolve_states()
        elements.move_uris(world, source.parent)
        for child in world.children:
            self._find_part(child)

    def text(self) -> bytes:
        """Return the document."""
        return self._document.text()

    def _dissolve_states(self) -> None:
        """Remove <state> and move its insertions into the world."""
        for state in self._world.all("state"):
            insertions = state.find("insertions")
            for child in [] if insertions is None else insertions.children:
                self._world.insert(child.copy())
            state.remove()

    def _find_part(self, child: XmlElement) -> None:
        if child.tag == "population" or (child.tag == "include" and child.get("merge") in ("true", "1")):
            self._multiple.append(child)
        elif child.tag in ("model", "light"):
            self._add_part(child.tag, child.get("name") or "", child)
        elif child.tag == "include":
            opened = self._elements.included_file(child, self._elements.folder)
            if opened is None:
                return
            root, name_element = opened[1].root, child.find("name")
            root_part = root if root.tag == "robot" else root.find("model") or root.find("light")
            if root_part is not None:
                name = "" if name_element is None else name_element.text
                tag = "light" if root_part.tag == "light" else "model"
                self._add_part(tag, name or root_part.get("name") or "", child)

    def _add_part(self, tag: str, name: str, element: XmlElement) -> None:
        """Index an element; a second model of the same name gets a number, as in the reader."""
        unique, number = name, 0
        while tag == "model" and (tag, unique) in self._parts:
            unique, number = f"{name}_{number}", number + 1
        if unique != name:
            _set_name(element, unique)
        self._parts[tag, unique] = element

    # -- changes

    def change(self, current: World, target: World, *, rewrite: bool) -> None:
        """Edit the differences between two flat worlds.

        Args:
            current: world that the document describes.
            target: world to describe.
            rewrite: replace the elements of differing models and lights instead of editing them.
        """
        self._change_physics(current, target)
        self._unroll(current, target)
        self._change_lights(current.lights, target.lights, rewrite=rewrite)
        current_models = {model.name: model for model in current.models}
        for name in current_models.keys() - {model.name for model in target.models}:
            self._remove("model", name)
        for model in target.models:
            before = current_models.get(model.name)
            if before is None:
                self._add(model)
            elif before != model:
                self._change_model(before, model, rewrite=rewrite)
        self._change_joints(current, target)
        self._write_state(target)

    def _change_physics(self, current: World, target: World) -> None:
        profiles = self._world.all("physics")
        physics = next((p for p in profiles if p.get("default") in ("1", "true")), profiles[0] if profiles else None)
        if current.physics.max_step_size_s != target.physics.max_step_size_s:
            if physics is None:
                new = '<physics name="default_physics" default="true" type="ode"/>'
                physics = self._world.insert(XmlElement.parse(new), at=0)
            put_value(physics, "max_step_size", target.physics.max_step_size_s)
        if current.physics.gravity != target.physics.gravity:
            home = physics if physics is not None and physics.find("gravity") is not None else self._world
            put_value(home, "gravity", target.physics.gravity)
        if current.wind != target.wind:
            put_value(self._world.put("wind"), "linear_velocity", target.wind)

    def _unroll(self, current: World, target: World) -> None:
        """Replace the elements that create several models by those models once one of them differs."""
        owned = {name for tag, name in self._parts if tag == "model"}
        before = {model.name: model for model in current.models if model.name not in owned}
        after = {model.name: model for model in target.models if model.name in before}
        if self._multiple and before != after:
            for element in self._multiple:
                element.remove()
            self._multiple.clear()
            for model in after.values():
                self._put("model", model.name, self._elements.written(model))

    def _change_lights(self, current: Iterable[Light], target: Iterable[Light], *, rewrite: bool) -> None:
        current_lights = {light.name: light for light in current}
        for name in current_lights.keys() - {light.name for light in target}:
            self._remove("light", name)
        for light in target:
            before = current_lights.get(light.name)
            element = self._parts.get(("light", light.name))
            if before is None or element is None:
                self._put("light", light.name, self._posed(light, light.world_from_light))
            elif before != light and rewrite:
                self._replace("light", light.name, self._elements.written(light))
            elif before != light:
                if before.world_from_light != light.world_from_light:
                    set_pose(element, light.world_from_light)
                if element.tag == "include" and _looks(before) != _looks(light):
                    element = self._inline("light", light.name) or element
                if element.tag == "light":
                    set_light(element, before, light)

    def _add(self, model: Model) -> None:
        self._put("model", model.name, self._posed(model, model.world_from_model))

    def _posed(self, part: Model | Light, pose: Pose) -> XmlElement:
        element = self._elements.of(part)
        set_pose(element, pose)
        return element

    def _change_model(self, current: Model, target: Model, *, rewrite: bool) -> None:
        key = ("model", target.name)
        if key not in self._parts:
            return
        if rewrite:
            self._replace(*key, self._elements.written(target))
            self._note_displacement(current, target)
            return
        if current.world_from_model != target.world_from_model:
            set_pose(self._parts[key], target.world_from_model)
        self._note_displacement(current, target)
        links = {link.name: link for link in current.links}
        for link in target.links:
            before = links.get(link.name)
            same = before is None or (before.inertial, before.collisions, before.lights) == (
                link.inertial, link.collisions, link.lights
            )  # fmt: skip
            if before is None or same or (element := self._link(target.name, link.name)) is None:
                continue
            if before.inertial != link.inertial:
                set_inertial(element, link.inertial)
            set_frictions(element, before.collisions, link.collisions)
            lights = {light.get("name"): light for light in element.all("light")}
            for old, new in zip(before.lights, link.lights, strict=False):
                if old != new and new.name in lights:
                    set_light(lights[new.name], old, new)

    def _note_displacement(self, current: Model, target: Model) -> None:
        current_poses = {link.name: (link.model_from_link, link.initial_pose) for link in current.links}
        if any(current_poses.get(link.name) != (link.model_from_link, link.initial_pose) for link in target.links):
            self._displaced[target.name] = target

    def _link(self, model: str, link: str) -> XmlElement | None:
        """Return the <link> of a model, or `inner::link` of a nested one; an <include> is replaced by its content."""
        element = self._parts["model", model]
        if element.tag == "include":
            inlined = self._inline("model", model)
            if inlined is None:
                return None
            element = inlined
        *scopes, name = link.split("::")
        for scope in scopes:
            nested = next((child for child in element.all("model") if child.get("name") == scope), None)
            if nested is None:
                return None
            element = nested
        return next((child for child in element.all("link") if child.get("name") == name), None)

    def _inline(self, tag: str, name: str) -> XmlElement | None:
        """Replace an <include> by its content."""
        content = self._elements.content_of(self._parts[tag, name], self._elements.folder)
        if content is not None:
            self._replace(tag, name, content)
        return content

    def _change_joints(self, current: World, target: World) -> None:
        before, after = {joint.name for joint in current.joints}, {joint.name for joint in target.joints}
        for element in self._world.all("joint"):
            if element.get("name") in before - after:
                element.remove()
        for name in after - before:
            if (joint := self._elements.joint(target, name)) is not None:
                self._world.insert(joint)

    def _write_state(self, target: World) -> None:
        for state in self._world.all("state"):
            state.remove()
        models = {model.name: model for model in target.models}
        moved = [models[name] for name in self._displaced if name in models]
        if moved:
            state = self._world.insert(XmlElement.parse("<state/>"))
            state.set("world_name", target.name)
            for model in moved:
                _add_state(state, model)

    def _put(self, tag: str, name: str, element: XmlElement) -> None:
        last = max((i for i, child in enumerate(self._world.raw) if child.tag in ("model", "include")), default=-1)
        self._parts[tag, name] = self._world.insert(element, at=last + 1 if last >= 0 else None)

    def _replace(self, tag: str, name: str, element: XmlElement) -> None:
        self._parts[tag, name].replace([element])
        self._parts[tag, name] = element

    def _remove(self, tag: str, name: str) -> None:
        element = self._parts.pop((tag, name), None)
        if element is not None:
            element.remove()


def is_editable(version: tuple[int, int]) -> bool:
    """True if files of an SDF version can be edited in place."""
    return version >= _OLDEST_COPIED


def new_document(world: World) -> XmlDocument:
    """Return the document of a world without its models, lights and joints."""
    bare = replace(world, models=(), lights=(), joints=())
    text = write_sdf(bare, is_world=True, uri_of=written_uri, report=Diagnostics())
    return XmlDocument(text, name=world.name)


def _set_name(element: XmlElement, name: str) -> None:
    if element.tag == "include":
        element.put("name", name)
    else:
        element.set("name", name)


def _looks(light: Light) -> object:
    return light.diffuse, light.intensity


def _add_state(state: XmlElement, model: Model) -> None:
    """Append the world poses of a model and its links; nested models have elements of their own."""
    elements = {"": state.insert(XmlElement.parse("<model/>"))}
    elements[""].set("name", model.name)
    put_value(elements[""], "pose", model.world_from_model.as_list())
    for link in model.links:
        scope, _, name = link.name.rpartition("::")
        pose = model.world_from_model @ (link.initial_pose or link.model_from_link)
        link_element = _model_element(elements, scope).insert(XmlElement.parse("<link/>"))
        link_element.set("name", name)
        link_element.put("pose", format_value(pose.as_list()))


def _model_element(elements: dict[str, XmlElement], scope: str) -> XmlElement:
    if scope not in elements:
        outer, _, name = scope.rpartition("::")
        elements[scope] = _model_element(elements, outer).insert(XmlElement.parse("<model/>"))
        elements[scope].set("name", name)
    return elements[scope]
