"""SDF of one model under change; comments and unknown elements stay."""

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
"""Tag of a part → tags of elements whose text names it."""
_FRAME_ATTRIBUTES = ("relative_to", "attached_to", "expressed_in", "canonical_link", "placement_frame")


class ModelDocument:
    """Document with one <model>."""

    def __init__(self, text: bytes) -> None:
        self._document = XmlDocument(text, name="model.sdf")
        model = self._document.root.find("model")
        assert model is not None, "a model's document has a <model>"
        self.model = model

    def text(self) -> bytes:
        """Return the document as UTF-8."""
        return self._document.text()

    def line(self, element: XmlElement) -> int:
        """Return the line of an element as it was parsed."""
        return self._document.line(element) or 1

    def parts(self) -> Iterator[tuple[Part, XmlElement]]:
        """Return every part below the model with its address, in file order; of two with one name the first counts."""
        seen: set[Part] = set()
        for part, element in _below((), self.model):
            if part not in seen:
                seen.add(part)
                yield part, element

    def find(self, part: Part) -> XmlElement:
        """Return the element of a part.

        Raises:
            UsageError: there is none.
        """
        element = self.model
        for tag, name in zip(part[::2], part[1::2], strict=False):
            found = None
            if tag in _CHILDREN.get(element.tag, ()):
                found = next((each for each in element.all(tag) if each.get("name") == name), None)
            if found is None:
                raise UsageError(f"the model has no {tag} {name!r} any more")
            element = found
        if len(part) % 2:
            raise UsageError("a part is addressed by tags and names in turn")
        return element

    def home(self, part: Part) -> XmlElement:
        """Return the <model> that a part is in; nested models have their own names."""
        nested = 0
        while part[2 * nested : 2 * nested + 1] == ("model",):
            nested += 1
        return self.find(part[: 2 * nested])

    def rename(self, part: Part, name: str) -> Part:
        """Rename a part, and what refers to it; return its new address.

        Raises:
            UsageError: another one has that name.
        """
        element = self.find(part)
        if not part:
            element.set("name", name)
            return part
        if any(each != element and each.get("name") == name for each in self.find(part[:-2]).all(element.tag)):
            raise UsageError(f"there is a {element.tag} {name!r} already")
        old = part[-1]
        element.set("name", name)
        self._rename_references(self.home(part), element.tag, old, name)
        return (*part[:-1], name)

    def _rename_references(self, home: XmlElement, tag: str, old: str, new: str) -> None:
        named = _REFERENCES.get(tag, ())
        for element in home.descendants():
            if tag in ("link", "joint"):
                for attribute in _FRAME_ATTRIBUTES:
                    if element.get(attribute) == old:
                        element.set(attribute, new)
            if element.text != old or element.children:
                continue
            if element.tag in named or (tag in ("link", "joint") and _is_in_plugin(element)):
                element.text = new
        if tag == "link" and home.get("canonical_link") == old:
            home.set("canonical_link", new)

    def joints_of(self, part: Part) -> list[XmlElement]:
        """Return the joints at a link."""
        ends = [[end.text for end in (j.find("parent"), j.find("child")) if end] for j in self.home(part).all("joint")]
        return [joint for joint, at in zip(self.home(part).all("joint"), ends, strict=True) if part[-1] in at]


def _below(part: Part, element: XmlElement) -> Iterator[tuple[Part, XmlElement]]:
    for child in element.children:
        if child.tag in _CHILDREN.get(element.tag, ()):
            address = (*part, child.tag, child.get("name") or "")
            yield address, child
            if len(address) < 10:
                yield from _below(address, child)


def _is_in_plugin(element: XmlElement) -> bool:
    return any(each.tag == "plugin" for each in element.ancestors())


def free_name(home: XmlElement, tag: str, name: str) -> str:
    """Return a name that no child with a tag has: `name`, `name_1`, …"""
    taken = {each.get("name") for each in home.children if each.tag in (tag, "link", "joint", "model")}
    number, free = 0, name
    while free in taken:
        number += 1
        free = f"{name}_{number}"
    return free
