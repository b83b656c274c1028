"""New XML elements for models and lights."""

import os
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.base.xmlnode import XmlDocument, XmlElement
from trundle.robots.model import Light, Model, World
from trundle.robots.packages import Packages, model_file

from ..writing import write_sdf, written_uri

_AXES_IN_JOINTS = (1, 5)
"""First version with axes in the joint frame."""
_EXPRESSED_IN = (1, 7)
"""First version that names the frame of an axis."""
_URIS = ("uri", "filename", "diffuse", "normal")


class Elements:
    """Factory of elements for one document."""

    def __init__(self, packages: Packages, folder: Path, version: tuple[int, int]) -> None:
        """Create.

        Args:
            packages: finds the models that can be included.
            folder: folder of the file to save.
            version: its SDF version.
        """
        self.packages = packages
        self.folder = folder
        self.version = version

    def of(self, part: Model | Light) -> XmlElement:
        """Return an <include> of a part on the model path, else a copy of its XML, else the part written as SDF."""
        return self._include(part) or self.copied(part) or self.written(part)

    def _include(self, part: Model | Light) -> XmlElement | None:
        file = Path(part.at.file).absolute()
        for folder in (file.parent, file.parent.parent):
            try:
                is_on_path = os.path.samefile(self.packages.find_model(folder.name), folder)
                if is_on_path and os.path.samefile(model_file(folder, Diagnostics()), file):
                    return XmlElement.parse(
                        f"<include><uri>model://{folder.name}</uri><name>{_escaped(part.name)}</name></include>"
                    )
            except (DescriptionError, UsageError, OSError):
                continue
        return None

    def copied(self, part: Model | Light) -> XmlElement | None:
        """Return a copy of a part's original element; None if the part has no element, or comes from a URDF."""
        file = Path(part.at.file)
        try:
            document = XmlDocument.read(file)
        except (DescriptionError, OSError):
            return None
        tag = "model" if isinstance(part, Model) else "light"
        matches = [e for e in document.root.descendants() if e.tag == tag and document.line(e) == part.at.line]
        if document.root.tag != "sdf" or len(matches) != 1:
            return None
        copied = matches[0].copy()
        copied.set("name", part.name)
        self.move_uris(copied, file.parent)
        return copied

    def written(self, part: Model | Light) -> XmlElement:
        """Return a part written as SDF, with explicit defaults."""
        models, lights = ((part,), ()) if isinstance(part, Model) else ((), (part,))
        world = World(name="", at=part.at, models=models, lights=lights)
        text = write_sdf(world, is_world=False, uri_of=written_uri, report=Diagnostics())
        element = XmlDocument(text, name=part.name).root.children[0].copy()
        self._write_axis_frames(element)
        self._write_old_defaults(element)
        return element

    def _write_old_defaults(self, element: XmlElement) -> None:
        """Write the values whose defaults differ in the document's version."""
        for surface in (node.put("surface") for node in element.descendants() if node.tag == "collision"):
            if self.version < (1, 4):
                ode = surface.put("friction").put("ode")
                for tag in ("mu", "mu2"):
                    if ode.find(tag) is None:
                        ode.put(tag, "1")
            elif self.version == (1, 4) and surface.put("contact").find("collide_bitmask") is None:
                surface.put("contact").put("collide_bitmask", "65535")

    def _write_axis_frames(self, element: XmlElement) -> None:
        """Mark axes as in the model frame, in the syntax of the document's version."""
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
        joint_world = World(name="", at=world.at, models=world.models, joints=joints)
        text = write_sdf(joint_world, is_world=True, uri_of=written_uri, report=Diagnostics())
        home = XmlDocument(text, name=name).root.find("world")
        element = None if home is None else home.find("joint")
        return None if element is None else element.copy()

    def content_of(self, include: XmlElement, folder: Path) -> XmlElement | None:
        """Return the included model or light, with the overrides; None if it cannot be read or is a URDF.

        Args:
            include: <include>.
            folder: base of its URI.
        """
        opened = self.included_file(include, folder)
        if opened is None or opened[1].root.tag != "sdf":
            return None
        file, document = opened
        content = document.root.find("model") or document.root.find("light")
        if content is None:
            return None
        copied = content.copy()
        self.move_uris(copied, file.parent)
        for tag in ("pose", "static"):
            if (override := include.find(tag)) is not None:
                if (overridden := copied.find(tag)) is not None:
                    overridden.remove()
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
        """Return the included file and its content; None if it cannot be read."""
        uri = include.find("uri")
        try:
            path = self.packages.resolve("" if uri is None else uri.text, folder=folder, at=Source("include"))
            file = model_file(path, Diagnostics()) if path.is_dir() else path
            return file, XmlDocument.read(file)
        except (DescriptionError, UsageError):
            return None

    def move_uris(self, element: XmlElement, folder: Path) -> None:
        """Rewrite an element's URIs relative to `folder` as relative to the document's."""
        if os.path.realpath(folder) == os.path.realpath(self.folder):
            return
        for node in element.descendants():
            path = node.text.removeprefix("file://")
            if node.tag not in _URIS or "://" in path or not path or os.path.isabs(path):
                continue
            target = folder / path
            if os.path.exists(target):
                node.text = self._uri(target)

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
