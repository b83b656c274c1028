"""Editable SDF of one model; comments and unknown elements are kept."""

from collections.abc import Iterator

from trundle.base.diagnostics import UsageError
from trundle.base.xmlnode import XmlDocument, XmlElement
from trundle.page import Part

_CHILDREN = {
    "model": ("link", "joint", "plugin", "model"),
    "link": ("visual", "collision", "sensor"),
    "joint": ("sensor",),
    "sensor": ("plugin",),
}
"""Tags of an element's parts."""
_REFERENCES = {"link": ("parent", "child", "link"), "joint": ("joint",), "collision": ("collision",)}
"""Tag of a part → tags of elements whose text refers to it."""
_FRAME_ATTRIBUTES = ("relative_to", "attached_to", "expressed_in", "canonical_link", "placement_frame")


class ModelDocument:
    """SDF document with one <model>."""

    def __init__(self, text: bytes) -> None:
        self._document = XmlDocument(text, name="model.sdf")
        model = self._document.root.find("model")
        assert model is not None, "a model's document has a <model>"
        self.model = model

    def text(self) -> bytes:
        """Return the document as UTF-8."""
        return self._document.text()

    def line(self, element: XmlElement) -> int:
        """Return the line of an element in the parsed text."""
        return self._document.line(element) or 1

    def parts(self) -> Iterator[tuple[Part, XmlElement]]:
        """Yield every part in the model with its address, in file order; of parts with the same name only the first."""
        addresses: set[Part] = set()
        for part, element in _below((), self.model):
            if part not in addresses:
                addresses.add(part)
                yield part, element

    def find(self, part: Part) -> XmlElement:
        """Return the element of a part.

        Raises:
            UsageError: there is no such part.
        """
        element = self.model
        for tag, name in zip(part[::2], part[1::2], strict=False):
            child = None
            if tag in _CHILDREN.get(element.tag, ()):
                child = next((child for child in element.all(tag) if child.get("name") == name), None)
            if child is None:
                raise UsageError(f"the model has no {tag} {name!r}")
            element = child
        if len(part) % 2:
            raise UsageError("a part's address alternates tags and names")
        return element

    def model_of(self, part: Part) -> XmlElement:
        """Return the innermost <model> around a part, in which its name is unique."""
        nested = 0
        while part[2 * nested : 2 * nested + 1] == ("model",):
            nested += 1
        return self.find(part[: 2 * nested])

    def rename(self, part: Part, name: str) -> Part:
        """Rename a part and update references to it; return its new address.

        Raises:
            UsageError: another part has that name.
        """
        element = self.find(part)
        if not part:
            element.set("name", name)
            return part
        siblings = self.find(part[:-2]).all(element.tag)
        if any(sibling != element and sibling.get("name") == name for sibling in siblings):
            raise UsageError(f"there is a {element.tag} {name!r} already")
        old = part[-1]
        element.set("name", name)
        self._rename_references(self.model_of(part), element.tag, old, name)
        return (*part[:-1], name)

    def _rename_references(self, model: XmlElement, tag: str, old: str, new: str) -> None:
        reference_tags = _REFERENCES.get(tag, ())
        for element in model.descendants():
            if tag in ("link", "joint"):
                for attribute in _FRAME_ATTRIBUTES:
                    if element.get(attribute) == old:
                        element.set(attribute, new)
            if element.text != old or element.children:
                continue
            if element.tag in reference_tags or (tag in ("link", "joint") and _is_in_plugin(element)):
                element.text = new
        if tag == "link" and model.get("canonical_link") == old:
            model.set("canonical_link", new)

    def joints_of(self, part: Part) -> list[XmlElement]:
        """Return the joints whose parent or child is a link."""
        joints = self.model_of(part).all("joint")
        ends = [[end.text for end in (joint.find("parent"), joint.find("child")) if end] for joint in joints]
        return [joint for joint, links in zip(joints, ends, strict=True) if part[-1] in links]


def _below(part: Part, element: XmlElement) -> Iterator[tuple[Part, XmlElement]]:
    for child in element.children:
        if child.tag in _CHILDREN.get(element.tag, ()):
            address = (*part, child.tag, child.get("name") or "")
            yield address, child
            if len(address) < 10:
                yield from _below(address, child)


def _is_in_plugin(element: XmlElement) -> bool:
    return any(ancestor.tag == "plugin" for ancestor in element.ancestors())


def free_name(parent: XmlElement, tag: str, name: str) -> str:
    """Return an unused name for a new child: `name`, `name_1`, …"""
    used = {child.get("name") for child in parent.children if child.tag in (tag, "link", "joint", "model")}
    number, free = 0, name
    while free in used:
        number += 1
        free = f"{name}_{number}"
    return free
