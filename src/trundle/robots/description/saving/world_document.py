"""XML of a world, with the element of each model and light."""

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
"""Before, values were attributes."""


class WorldDocument:
    """A world's XML under change."""

    def __init__(self, document: XmlDocument, source: Path, elements: Elements) -> None:
        """Take a document with a <world>.

        Args:
            document: to change.
            source: file that it was read from; base of its relative URIs.
            elements: make what is new.
        """
        world = document.root.find("world")
        assert world is not None, "a document of a world has a <world>"
        self._document, self._world, self._elements = document, world, elements
        self._parts: dict[tuple[str, str], XmlElement] = {}
        """(tag, name) → element, which may be an <include>."""
        self._several: list[XmlElement] = []
        """Elements that make several models, or such as dissolve into the world."""
        self._stated: dict[str, Model] = {}
        """Models with links that are not where their joints' zeros are."""
        self._dissolve_states()
        elements.move_uris(world, source.parent)
        for child in world.children:
            self._find_part(child)

    def text(self) -> bytes:
        """Return the document."""
        return self._document.text()

    def _dissolve_states(self) -> None:
        """Drop <state>, whose insertions become parts of the world."""
        for state in self._world.all("state"):
            insertions = state.find("insertions")
            for each in [] if insertions is None else insertions.children:
                self._world.insert(each.copy())
            state.remove()

    def _find_part(self, child: XmlElement) -> None:
        if child.tag == "population" or (child.tag == "include" and child.get("merge") in ("true", "1")):
            self._several.append(child)
        elif child.tag in ("model", "light"):
            self._add_part(child.tag, child.get("name") or "", child)
        elif child.tag == "include":
            opened = self._elements.included_file(child, self._elements.folder)
            if opened is None:
                return
            root, named = opened[1].root, child.find("name")
            inside = root if root.tag == "robot" else root.find("model") or root.find("light")
            if inside is not None:
                name = "" if named is None else named.text
                tag = "light" if inside.tag == "light" else "model"
                self._add_part(tag, name or inside.get("name") or "", child)

    def _add_part(self, tag: str, name: str, element: XmlElement) -> None:
        """Remember an element; a second model of a name has a number, as the reader gives it."""
        unique, number = name, 0
        while tag == "model" and (tag, unique) in self._parts:
            unique, number = f"{name}_{number}", number + 1
        if unique != name:
            _set_name(element, unique)
        self._parts[tag, unique] = element

    # -- changes

    def change(self, have: World, want: World, *, rewrite: bool) -> None:
        """Change what differs between two flat worlds.

        Args:
            have: what the document says now.
            want: what it is to say.
            rewrite: write models and lights that still differ as they are, instead of changing their elements.
        """
        self._change_physics(have, want)
        self._unroll(have, want)
        self._change_lights(have.lights, want.lights, rewrite=rewrite)
        there = {model.name: model for model in have.models}
        for name in there.keys() - {model.name for model in want.models}:
            self._remove("model", name)
        for model in want.models:
            before = there.get(model.name)
            if before is None:
                self._add(model)
            elif before != model:
                self._change_model(before, model, rewrite=rewrite)
        self._change_joints(have, want)
        self._write_state(want)

    def _change_physics(self, have: World, want: World) -> None:
        profiles = self._world.all("physics")
        physics = next((p for p in profiles if p.get("default") in ("1", "true")), profiles[0] if profiles else None)
        if have.physics.max_step_size_s != want.physics.max_step_size_s:
            if physics is None:
                new = '<physics name="default_physics" default="true" type="ode"/>'
                physics = self._world.insert(XmlElement.parse(new), at=0)
            put_value(physics, "max_step_size", want.physics.max_step_size_s)
        if have.physics.gravity != want.physics.gravity:
            home = physics if physics is not None and physics.find("gravity") is not None else self._world
            put_value(home, "gravity", want.physics.gravity)
        if have.wind != want.wind:
            put_value(self._world.put("wind"), "linear_velocity", want.wind)

    def _unroll(self, have: World, want: World) -> None:
        """Write what makes several models out, as soon as one of them changes."""
        owned = {name for tag, name in self._parts if tag == "model"}
        before = {model.name: model for model in have.models if model.name not in owned}
        after = {model.name: model for model in want.models if model.name in before}
        if self._several and before != after:
            for element in self._several:
                element.remove()
            self._several.clear()
            for model in after.values():
                self._put("model", model.name, self._elements.written(model))

    def _change_lights(self, have: Iterable[Light], want: Iterable[Light], *, rewrite: bool) -> None:
        there = {light.name: light for light in have}
        for name in there.keys() - {light.name for light in want}:
            self._remove("light", name)
        for light in want:
            before = there.get(light.name)
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

    def _change_model(self, have: Model, want: Model, *, rewrite: bool) -> None:
        key = ("model", want.name)
        if key not in self._parts:
            return
        if rewrite:
            self._replace(*key, self._elements.written(want))
            self._state_if_moved(have, want)
            return
        if have.world_from_model != want.world_from_model:
            set_pose(self._parts[key], want.world_from_model)
        self._state_if_moved(have, want)
        links = {link.name: link for link in have.links}
        for link in want.links:
            before = links.get(link.name)
            same = before is None or (before.inertial, before.collisions, before.lights) == (
                link.inertial, link.collisions, link.lights
            )  # fmt: skip
            if before is None or same or (element := self._link(want.name, link.name)) is None:
                continue
            if before.inertial != link.inertial:
                set_inertial(element, link.inertial)
            set_frictions(element, before.collisions, link.collisions)
            lights = {each.get("name"): each for each in element.all("light")}
            for old, new in zip(before.lights, link.lights, strict=False):
                if old != new and new.name in lights:
                    set_light(lights[new.name], old, new)

    def _state_if_moved(self, have: Model, want: Model) -> None:
        was = {link.name: (link.model_from_link, link.initial_pose) for link in have.links}
        if any(was.get(link.name) != (link.model_from_link, link.initial_pose) for link in want.links):
            self._stated[want.name] = want

    def _link(self, model: str, link: str) -> XmlElement | None:
        """Return the <link> of a model, `inner::link` of one nested in it; includes on the way are written out."""
        element = self._parts["model", model]
        if element.tag == "include":
            inlined = self._inline("model", model)
            if inlined is None:
                return None
            element = inlined
        *scopes, name = link.split("::")
        for scope in scopes:
            inner = next((each for each in element.all("model") if each.get("name") == scope), None)
            if inner is None:
                return None
            element = inner
        return next((each for each in element.all("link") if each.get("name") == name), None)

    def _inline(self, tag: str, name: str) -> XmlElement | None:
        """Put what an <include> includes in its place."""
        content = self._elements.content_of(self._parts[tag, name], self._elements.folder)
        if content is not None:
            self._replace(tag, name, content)
        return content

    def _change_joints(self, have: World, want: World) -> None:
        before, after = {joint.name for joint in have.joints}, {joint.name for joint in want.joints}
        for element in self._world.all("joint"):
            if element.get("name") in before - after:
                element.remove()
        for name in after - before:
            if (joint := self._elements.joint(want, name)) is not None:
                self._world.insert(joint)

    def _write_state(self, want: World) -> None:
        for state in self._world.all("state"):
            state.remove()
        there = {model.name: model for model in want.models}
        moved = [there[name] for name in self._stated if name in there]
        if moved:
            state = self._world.insert(XmlElement.parse("<state/>"))
            state.set("world_name", want.name)
            for model in moved:
                _add_state(state, model)

    def _put(self, tag: str, name: str, element: XmlElement) -> None:
        last = max((i for i, each in enumerate(self._world.raw) if each.tag in ("model", "include")), default=-1)
        self._parts[tag, name] = self._world.insert(element, at=last + 1 if last >= 0 else None)

    def _replace(self, tag: str, name: str, element: XmlElement) -> None:
        self._parts[tag, name].replace([element])
        self._parts[tag, name] = element

    def _remove(self, tag: str, name: str) -> None:
        element = self._parts.pop((tag, name), None)
        if element is not None:
            element.remove()


def is_editable(version: tuple[int, int]) -> bool:
    """True if files of an SDF version can be changed in place."""
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
    """Append the poses of a model and its links in the world; links of nested models stand in theirs."""
    homes = {"": state.insert(XmlElement.parse("<model/>"))}
    homes[""].set("name", model.name)
    put_value(homes[""], "pose", model.world_from_model.as_list())
    for link in model.links:
        scope, _, name = link.name.rpartition("::")
        pose = model.world_from_model @ (link.initial_pose or link.model_from_link)
        element = _home(homes, scope).insert(XmlElement.parse("<link/>"))
        element.set("name", name)
        element.put("pose", format_value(pose.as_list()))


def _home(homes: dict[str, XmlElement], scope: str) -> XmlElement:
    if scope not in homes:
        outer, _, name = scope.rpartition("::")
        homes[scope] = _home(homes, outer).insert(XmlElement.parse("<model/>"))
        homes[scope].set("name", name)
    return homes[scope]
