"""Parameters in the children of an XML element, such as an SDF <plugin>."""

from collections.abc import Sequence
from typing import Self

from trundle.base.diagnostics import Diagnostics, Source
from trundle.base.xmlnode import XmlNode

from .base import ParamError, Parameters

_OFF = {"0", "0.0", "false"}
"""Values that disable a parameter."""


class TagParameters(Parameters):
    """Parameters of one element; an invalid value gives a warning with its line, and the default is used."""

    __module__ = "trundle"

    def __init__(self, node: XmlNode | None, report: Diagnostics) -> None:
        """Wrap an element; None: no parameters."""
        self.node = node
        self.report = report

    def __contains__(self, name: str) -> bool:
        """True if the element has a child of that name."""
        return self._child(name) is not None

    def section(self, name: str) -> Self:
        """Return the parameters of a child."""
        return type(self)(self._child(name), self.report)

    def sections(self, name: str) -> list[Self]:
        """Return the parameters of each child of one name."""
        return [type(self)(child, self.report) for child in self._children(name)]

    def text(self, name: str, default: str | None = None) -> str:
        """Return a text; a required one must not be empty."""
        value = super().text(name, default)
        if default is None and not value:
            raise self._missing(name)
        return value

    def texts(self, name: str) -> list[str]:
        """Return the texts of all children of one name."""
        return [child.text for child in self._children(name)]

    def attribute(self, name: str) -> str:
        """Return an attribute of the element; empty if absent."""
        return "" if self.node is None else self.node.attribute(name) or ""

    @property
    def at(self) -> Source:
        """Source position of the start tag."""
        assert self.node is not None, "the element exists"
        return self.node.at

    def warn(self, message: str, name: str | None = None) -> None:
        """Report a warning at the element, or at one of its parameters."""
        child = None if name is None else self._child(name)
        self.report.warn(self.at if child is None else child.at, message, "plugin-parameter")

    def ignore(self, *names: str) -> None:
        """Mark parameters without effect as read."""
        for name in names:
            self._child(name)

    def warn_unsupported(self, *names: str) -> None:
        """Mark parameters as read, and warn of those that are not disabled."""
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

    def _reject(self, name: str, message: str, default: object) -> None:
        if default is None:
            raise ParamError(f"<{name}>{message}")
        self.warn(f"<{name}>{message}; {_formatted(default)} is used", name)

    def _missing(self, name: str) -> ParamError:
        return ParamError(f"<{name}> is missing")


def _formatted(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return " ".join(f"{part:g}" for part in value)
    return str(value)
