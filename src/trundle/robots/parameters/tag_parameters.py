"""Parameters that an XML element has as its children, such as an SDF <plugin>."""

from collections.abc import Sequence
from typing import Self

from trundle.base.diagnostics import Diagnostics, Source
from trundle.base.xmlnode import XmlNode

from .base import ParamError, Parameters

_OFF = {"0", "0.0", "false"}
"""Values of parameters that ask for nothing."""


class TagParameters(Parameters):
    """Parameters of one element; a value of no use is named with its line, and the default is used."""

    def __init__(self, node: XmlNode | None, report: Diagnostics) -> None:
        """Read from an element; None: from one without any."""
        self.node = node
        self.report = report

    def __contains__(self, name: str) -> bool:
        """Tell whether the element has such a child."""
        return self._child(name) is not None

    def section(self, name: str) -> Self:
        """The parameters of a child."""
        return type(self)(self._child(name), self.report)

    def sections(self, name: str) -> list[Self]:
        """The parameters of each child of one name."""
        return [type(self)(child, self.report) for child in self._children(name)]

    def text(self, name: str, default: str | None = None) -> str:
        """A text; one that is needed is not empty."""
        found = super().text(name, default)
        if default is None and not found:
            raise self._missing(name)
        return found

    def texts(self, name: str) -> list[str]:
        """The text of each child of one name."""
        return [child.text for child in self._children(name)]

    def attribute(self, name: str) -> str:
        """An attribute of the element; empty where it has none."""
        return "" if self.node is None else self.node.attribute(name) or ""

    @property
    def at(self) -> Source:
        """Position of the start tag."""
        assert self.node is not None, "the element is there"
        return self.node.at

    def warn(self, what: str, name: str | None = None) -> None:
        """Name what is wrong with the element, or with one of its parameters."""
        child = None if name is None else self._child(name)
        self.report.warn(self.at if child is None else child.at, what)

    def ignore(self, *names: str) -> None:
        """Count parameters as read that have no effect."""
        for name in names:
            self._child(name)

    def warn_unsupported(self, *names: str) -> None:
        """Count parameters as read, and name those that would have an effect."""
        for name in names:
            child = self._child(name)
            if child is not None and not set(child.text.split()) <= _OFF:
                self.warn(f"<{name}> is not supported", name)

    def report_unread(self) -> None:
        """Warn of each parameter that was not read."""
        if self.node is not None:
            self.node.report_unread(self.report)

    def _child(self, name: str) -> XmlNode | None:
        return None if self.node is None else self.node.find(name)

    def _children(self, name: str) -> list[XmlNode]:
        return [] if self.node is None else self.node.all(name)

    def _find(self, name: str) -> str | None:
        child = self._child(name)
        return None if child is None else child.text

    def _refuse(self, name: str, what: str, default: object) -> None:
        if default is None:
            raise ParamError(f"<{name}>{what}")
        self.warn(f"<{name}>{what}; {_shown(default)} is used", name)

    def _missing(self, name: str) -> ParamError:
        return ParamError(f"<{name}> is missing")


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return " ".join(f"{part:g}" for part in value)
    return str(value)
