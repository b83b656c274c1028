"""Copy of a model being edited, with its undo history."""

import math
from collections.abc import Callable
from typing import NamedTuple

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.base.xmlnode import XmlElement
from trundle.gazebo.plugins import SENSOR_PLUGINS
from trundle.page import Part, Value
from trundle.robots.model import Box, Capsule, Cylinder, Geometry, Sphere
from trundle.spatial import Pose

from .document import ModelDocument, free_name
from .field import Field, number_text, write_value
from .inertia import density_of, weigh
from .joint_fields import WORLD, axis_count
from .link_fields import DENSITY, MASS
from .new_parts import new_joint, new_link, new_plugin, new_sensor, new_shape
from .reader import CheckedModel, ModelReader

_MAX_BYTES = 4_000_000
_MAX_UNDO = 200
_MAX_UNDO_BYTES = 64_000_000
_GAP_M = 0.2


class _Edit(NamedTuple):
    """Entry of the history: the model before an edit, or after an undone one."""

    title: str
    text: bytes
    world_from_model: Pose


class Draft:
    """Model being edited; an edit that makes it unreadable is refused."""

    def __init__(self, text: bytes, reader: ModelReader, *, original: str | None, world_from_model: Pose) -> None:
        """Read a model.

        Args:
            text: document with one <model>.
            reader: reads and checks the document.
            original: name of the copied model in the world; None: a new model.
            world_from_model: model's pose in the world.

        Raises:
            UsageError: the document cannot be read.
        """
        self.original = original
        self.world_from_model = world_from_model
        self._reader = reader
        self._done: list[_Edit] = []
        self._undone: list[_Edit] = []
        self.checked = self._check(text)

    @property
    def text(self) -> bytes:
        """Current document."""
        return self.checked.document.text()

    @property
    def name(self) -> str:
        """Model's name."""
        return self.checked.document.model.get("name") or "model"

    @property
    def undo_title(self) -> str | None:
        """Title of the edit to undo."""
        return self._done[-1].title if self._done else None

    @property
    def redo_title(self) -> str | None:
        """Title of the edit to redo."""
        return self._undone[-1].title if self._undone else None

    def undo(self) -> None:
        """Undo the latest edit."""
        self._swap(self._done, self._undone)

    def redo(self) -> None:
        """Redo the edit undone last."""
        self._swap(self._undone, self._done)

    def _swap(self, from_: "list[_Edit]", to: "list[_Edit]") -> None:
        if not from_:
            raise UsageError("nothing to undo or redo")
        edit = from_[-1]
        now = _Edit(edit.title, self.text, self.world_from_model)
        self.checked = self._check(edit.text)
        self.world_from_model = edit.world_from_model
        from_.pop()
        to.append(now)

    def set(self, part: Part, name: str, value: Value) -> Part:
        """Set a field of a part; return the part's address afterwards.

        Raises:
            TrundleError: the value is refused; the draft is unchanged.
        """
        field = self.checked.field(part, name)
        part_name = part[-1] if part else self.name

        def change(document: ModelDocument) -> Part:
            if name == "@name":
                if not isinstance(value, str) or not value.strip():
                    raise UsageError("a part needs a name")
                return document.rename(part, value.strip())
            self._set(document, part, field, value)
            return part

        return self._edit(f"{field.label} of {part_name}", change)

    def _set(self, document: ModelDocument, part: Part, field: Field, value: Value) -> None:
        element = document.find(part)
        owner = _link_part(part)
        if field.name == DENSITY:
            self._weigh(document, owner, density=_number(field, value))
            return
        before = self.checked.link(owner)
        write_value(element, field, value)
        if field.name == MASS and value is not None:
            self._weigh(document, owner, mass=_number(field, value))
        elif "geometry/" in field.name and element.tag in ("link", "collision") and before is not None:
            density = density_of(before)
            if density is not None:
                self._weigh(document, owner, density=density)
        elif field.name.endswith("material/diffuse"):
            visual = element.find("visual") if element.tag == "link" else element
            material = None if visual is None else visual.find("material")
            script = None if material is None else material.find("script")
            if script is not None:
                script.remove()
        elif field.name == "@type" and element.tag == "joint":
            _fit_axes(element)

    def _weigh(
        self, document: ModelDocument, part: Part, *, mass: float | None = None, density: float | None = None
    ) -> None:
        link = self._reader.read(document).link(part)
        if link is not None:
            weigh(document.find(part), link, mass=mass, density=density)

    def move(self, part: Part, pose: Pose) -> Part:
        """Move a link, or the model as a whole, to a pose in the world."""
        if not part:
            self._remember(_Edit(f"Pose of {self.name}", self.text, self.world_from_model))
            self.world_from_model = pose
            return part
        if len(part) != 2 or part[0] != "link":
            raise UsageError("only links of the outermost model can be dragged: set the pose in the form")
        model_from_link = self.world_from_model.inverse() @ pose

        def change(document: ModelDocument) -> Part:
            node = document.find(part).put("pose", number_text(model_from_link.as_list()))
            for attribute in ("relative_to", "frame", "degrees", "rotation_format"):
                node.set(attribute, None)
            return part

        return self._edit(f"Pose of {part[-1]}", change)

    def add(self, into: Part, kind: str, type_: str) -> Part:
        """Add a part; return its address.

        Args:
            into: part that it is added to; for a joint, its child.
            kind: tag of the part.
            type_: shape or mesh, type of the joint or sensor, file name of the plugin.
        """

        def change(document: ModelDocument) -> Part:
            parent = self._parent_for(document, into, kind, type_)
            element = document.find(parent)
            new = self._new(document, parent, into, kind, type_)
            _insert(element, new)
            added = (*parent, kind, new.get("name") or "")
            if kind == "link":
                self._weigh(document, added, mass=1.0)
            return added

        return self._edit(f"Add {kind} {type_.rpartition('/')[2]}", change)

    def _parent_for(self, document: ModelDocument, into: Part, kind: str, type_: str) -> Part:
        """Return the part to which a new one is added."""
        if kind in ("link", "joint"):
            return ()
        if kind == "plugin":
            if type_.rpartition("/")[2] not in SENSOR_PLUGINS:
                return ()
            if into[-2:-1] == ("sensor",):
                return into
            raise UsageError(f"{type_} publishes a sensor's readings: select the sensor first")
        owner = _link_part(into)
        if owner:
            return owner
        first = document.model.find("link")
        if first is None:
            raise UsageError(f"a {kind} belongs to a link: add a link first")
        return ("link", first.get("name") or "")

    def _new(self, document: ModelDocument, parent: Part, into: Part, kind: str, type_: str) -> XmlElement:
        element = document.find(parent)
        match kind:
            case "link":
                return new_link(type_, free_name(element, kind, _stem(type_)), self._right_edge())
            case "joint":
                parent_link, child = self._ends(document, into)
                return new_joint(type_, free_name(element, kind, f"{child}_joint"), parent_link, child)
            case "sensor":
                collision = element.find("collision")
                name = free_name(element, kind, {"ray": "lidar", "gpu_ray": "lidar"}.get(type_, type_))
                return new_sensor(type_, name, parent[-1], (collision.get("name") or "") if collision else "collision")
            case "plugin":
                stem = _stem(type_).removeprefix("lib").removeprefix("gazebo_ros_")
                return new_plugin(type_, free_name(element, kind, stem))
            case _:
                return new_shape(kind, type_, free_name(element, kind, kind))

    def _ends(self, document: ModelDocument, into: Part) -> tuple[str, str]:
        """Return parent and child of a new joint: the first link, and the selected or else the last one."""
        links = [link.get("name") or "" for link in document.model.all("link")]
        if not links:
            raise UsageError("a joint joins two links: add them first")
        owner = _link_part(into)
        joined = {child.text for joint in document.model.all("joint") if (child := joint.find("child"))}
        free = [name for name in links[1:] if name not in joined]
        child = owner[-1] if len(owner) == 2 else (free or links)[-1]
        return next((name for name in links if name != child), WORLD), child

    def _right_edge(self) -> float:
        """Return the x coordinate at which a new link stands beside all others [m]."""
        links = self.checked.model.links
        edges = [k.model_from_link.position[0] + _bounding_radius(c.geometry) for k in links for c in k.collisions]
        return round(max(edges) + 0.5 + _GAP_M, 2) if edges else 0.0

    def copy(self, part: Part) -> Part:
        """Add a copy of a part; return its address."""

        def change(document: ModelDocument) -> Part:
            element = document.find(part)
            if not part:
                raise UsageError("copy the model itself in the world, not in the editor")
            copied = element.copy()
            name = free_name(document.find(part[:-2]), element.tag, part[-1])
            copied.set("name", name)
            _insert(document.find(part[:-2]), copied)
            return (*part[:-1], name)

        return self._edit(f"Copy of {part[-1] if part else self.name}", change)

    def remove(self, part: Part) -> Part:
        """Remove a part, and the joints of a link; return the part that contained it."""

        def change(document: ModelDocument) -> Part:
            element = document.find(part)
            if not part:
                raise UsageError("delete the model itself in the world, not in the editor")
            for joint in document.joints_of(part) if element.tag == "link" else []:
                joint.remove()
            element.remove()
            return part[:-2]

        return self._edit(f"Remove {part[-1] if part else self.name}", change)

    def _edit(self, title: str, change: Callable[[ModelDocument], Part]) -> Part:
        before = self.text
        document = ModelDocument(before)
        part = change(document)
        text = document.text()
        if text == before:
            return part
        self.checked = self._check(text)
        self._remember(_Edit(title, before, self.world_from_model))
        return part

    def _remember(self, edit: "_Edit") -> None:
        self._done = [*self._done, edit][-_MAX_UNDO:]
        while sum(len(entry.text) for entry in self._done) > _MAX_UNDO_BYTES:
            del self._done[0]
        self._undone.clear()

    def _check(self, text: bytes) -> CheckedModel:
        if len(text) > _MAX_BYTES:
            raise UsageError(f"the model would be longer than {_MAX_BYTES / 1e6:g} MB")
        try:
            return self._reader.check(text, "model.sdf")
        except DescriptionError as error:
            raise UsageError(error.what) from None


def _link_part(part: Part) -> Part:
    """Return the link that a part is or belongs to; empty: none."""
    for end in range(len(part), 0, -2):
        if part[end - 2] == "link":
            return part[:end]
    return ()


def _insert(parent: XmlElement, new: XmlElement) -> None:
    """Insert an element after the last one with its tag."""
    last = max((i for i, child in enumerate(parent.raw) if child.tag == new.tag), default=-1)
    parent.insert(new, at=last + 1 if last >= 0 else None)


def _fit_axes(joint: XmlElement) -> None:
    """Add and remove axes of a joint to match its type."""
    tags = ("axis", "axis2")[: axis_count(joint.get("type") or "")]
    for tag, direction in (("axis", "0 0 1"), ("axis2", "1 0 0")):
        axis = joint.find(tag)
        if axis is not None and tag not in tags:
            axis.remove()
        elif axis is None and tag in tags:
            joint.insert(XmlElement.parse(f"<{tag}><xyz>{direction}</xyz></{tag}>"))


def _number(field: Field, value: Value) -> float:
    number = value[0] if isinstance(value, tuple) and len(value) == 1 else None
    if number is None or not field.minimum <= number <= field.maximum:
        raise UsageError(f"{field.label}: enter a number from {field.minimum:g} to {field.maximum:g}")
    return number


def _stem(type_: str) -> str:
    return type_.rpartition("/")[2].partition(".")[0] or "link"


def _bounding_radius(geometry: Geometry) -> float:
    """Return the radius of a sphere around a shape's origin that contains it [m]."""
    match geometry:
        case Box(size):
            return math.hypot(*size) / 2
        case Sphere(radius):
            return radius
        case Cylinder(radius, length):
            return math.hypot(radius, length / 2)
        case Capsule(radius, length):
            return radius + length / 2
        case _:
            return 0.5
