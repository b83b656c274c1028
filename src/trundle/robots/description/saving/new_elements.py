"""Elements for models and lights that a world's XML does not have yet."""

import os
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.base.xmlnode import XmlDocument, XmlElement
from trundle.robots.model import Light, Model, World
from trundle.robots.packages import Packages, model_file

from ..writing import write_sdf, written_uri

_AXES_IN_JOINTS = (1, 5)
"""First version with axes in the joint's frame."""
_EXPRESSED_IN = (1, 7)
"""First version that names the frame of an axis."""
_URIS = ("uri", "filename", "diffuse", "normal")


class Elements:
    """Maker of elements for one document."""

    def __init__(self, packages: Packages, folder: Path, version: tuple[int, int]) -> None:
        """Create.

        Args:
            packages: find the models that can be included.
            folder: of the file that is to be saved.
            version: of its SDF.
        """
        self.packages = packages
        self.folder = folder
        self.version = version

    def of(self, part: Model | Light) -> XmlElement:
        """Return an <include> of a model path's part, else a copy of its XML, else the part as it is written."""
        return self._include(part) or self.copied(part) or self.written(part)

    def _include(self, part: Model | Light) -> XmlElement | None:
        file = Path(part.at.file).absolute()
        for folder in (file.parent, file.parent.parent):
            try:
                is_found = os.path.samefile(self.packages.find_model(folder.name), folder)
                if is_found and os.path.samefile(model_file(folder, Diagnostics()), file):
                    return XmlElement.parse(
                        f"<include><uri>model://{folder.name}</uri><name>{_escaped(part.name)}</name></include>"
                    )
            except (DescriptionError, UsageError, OSError):
                continue
        return None

    def copied(self, part: Model | Light) -> XmlElement | None:
        """Return a copy of the element that a part was read from; None if there is none, or it is a URDF's."""
        file = Path(part.at.file)
        try:
            document = XmlDocument.read(file)
        except (DescriptionError, OSError):
            return None
        tag = "model" if isinstance(part, Model) else "light"
        found = [e for e in document.root.descendants() if e.tag == tag and document.line(e) == part.at.line]
        if document.root.tag != "sdf" or len(found) != 1:
            return None
        copied = found[0].copy()
        copied.set("name", part.name)
        self.move_uris(copied, file.parent)
        return copied

    def written(self, part: Model | Light) -> XmlElement:
        """Return a part written with all of it explicit."""
        models, lights = ((part,), ()) if isinstance(part, Model) else ((), (part,))
        world = World(name="", at=part.at, models=models, lights=lights)
        text = write_sdf(world, is_world=False, uri_of=written_uri, report=Diagnostics())
        element = XmlDocument(text, name=part.name).root.children[0].copy()
        self._downgrade_axes(element)
        self._state_old_defaults(element)
        return element

    def _state_old_defaults(self, element: XmlElement) -> None:
        """Write the values whose defaults were others in the document's version."""
        for surface in (each.put("surface") for each in element.descendants() if each.tag == "collision"):
            if self.version < (1, 4):
                ode = surface.put("friction").put("ode")
                for tag in ("mu", "mu2"):
                    if ode.find(tag) is None:
                        ode.put(tag, "1")
            elif self.version == (1, 4) and surface.put("contact").find("collide_bitmask") is None:
                surface.put("contact").put("collide_bitmask", "65535")

    def _downgrade_axes(self, element: XmlElement) -> None:
        """Say in the words of the document's version that axes are in the model's frame."""
        if self.version >= _EXPRESSED_IN:
            return
        for axis in element.descendants():
            direction = axis.find("xyz") if axis.tag in ("axis", "axis2") else None
            if direction is not None and direction.get("expressed_in") == "__model__":
                direction.set("expressed_in", None)
                if self.version >= _AXES_IN_JOINTS:
                    axis.put("use_parent_model_frame", "1")

    def joint(self, world: World, name: str) -> XmlElement | None:
        """Return the element of a joint between models; None if SDF has no such joint."""
        joints = tuple(joint for joint in world.joints if joint.name == name)
        alone = World(name="", at=world.at, models=world.models, joints=joints)
        text = write_sdf(alone, is_world=True, uri_of=written_uri, report=Diagnostics())
        home = XmlDocument(text, name=name).root.find("world")
        found = None if home is None else home.find("joint")
        return None if found is None else found.copy()

    def content_of(self, include: XmlElement, folder: Path) -> XmlElement | None:
        """Return what an <include> includes, with its overrides; None if it cannot be read or is a URDF.

        Args:
            include: the element.
            folder: base of its URI.
        """
        opened = self.included_file(include, folder)
        if opened is None or opened[1].root.tag != "sdf":
            return None
        file, document = opened
        found = document.root.find("model") or document.root.find("light")
        if found is None:
            return None
        copied = found.copy()
        self.move_uris(copied, file.parent)
        for tag in ("pose", "static"):
            if (override := include.find(tag)) is not None:
                if (own := copied.find(tag)) is not None:
                    own.remove()
                copied.insert(override.copy(), at=0)
        name, placement = include.find("name"), include.find("placement_frame")
        if name is not None and name.text:
            copied.set("name", name.text)
        if placement is not None:
            copied.set("placement_frame", placement.text)
        for plugin in include.all("plugin"):
            copied.insert(plugin.copy())
        return copied

    def included_file(self, include: XmlElement, folder: Path) -> tuple[Path, XmlDocument] | None:
        """Return the file that an <include> names, and its content; None if it cannot be read."""
        uri = include.find("uri")
        try:
            path = self.packages.resolve("" if uri is None else uri.text, beside=folder, at=Source("include"))
            file = model_file(path, Diagnostics()) if path.is_dir() else path
            return file, XmlDocument.read(file)
        except (DescriptionError, UsageError):
            return None

    def move_uris(self, element: XmlElement, folder: Path) -> None:
        """Have relative URIs of an element, written for a file of a folder, lead to the same files from here."""
        if os.path.realpath(folder) == os.path.realpath(self.folder):
            return
        for each in element.descendants():
            path = each.text.removeprefix("file://")
            if each.tag not in _URIS or "://" in path or not path or os.path.isabs(path):
                continue
            there = folder / path
            if os.path.exists(there):
                each.text = self._uri(there)

    def _uri(self, file: Path) -> str:
        for folder in file.absolute().parents:
            try:
                if os.path.samefile(self.packages.find_model(folder.name), folder):
                    return f"model://{folder.name}/{file.absolute().relative_to(folder).as_posix()}"
            except (UsageError, OSError):
                continue
        return Path(os.path.relpath(os.path.realpath(file), os.path.realpath(self.folder))).as_posix()


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")
