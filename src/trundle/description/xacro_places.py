"""Keeps where each element of a xacro file stands, and which one the package is at."""

import xml.dom.expatbuilder
from collections.abc import Callable
from typing import Any

from trundle.diagnostics import Source

_AT = "at"


class _Kept:
    """Has clones of an element know where it stands."""

    @staticmethod
    def handle(operation: int, key: str, data: Any, src: Any, dst: Any) -> None:
        """See the DOM's UserDataHandler; nothing is copied to when an element is thrown away."""
        del operation, src
        if dst is not None:
            dst.setUserData(key, data, _Kept)


class _SourceBuilder(xml.dom.expatbuilder.ExpatBuilderNS):
    """Builds a document whose elements know where they stand."""

    def __init__(self, file: str, first_line: int) -> None:
        super().__init__()
        self._file = file
        self._first_line = first_line

    def start_element_handler(self, name: Any, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        line = self.getParser().CurrentLineNumber + self._first_line
        self.curNode.setUserData(_AT, Source(self._file, line), _Kept)


def parse_with_lines(data: bytes, file: str) -> Any:
    """The document of a file, which may start with blank lines; of its elements `place_of` knows where they stand.

    Raises:
        ExpatError: it is not well-formed.
    """
    document = data.lstrip()
    return _SourceBuilder(file, data[: len(data) - len(document)].count(b"\n")).parseString(document)


def place_of(element: Any) -> Source:
    """Where an element of a parsed file stands, or the one that it is a copy of."""
    return element.getUserData(_AT)


class Cursor:
    """The place in the files that the package is at."""

    def __init__(self, at: Source) -> None:
        self.at = at

    def follow(self, package: Any) -> None:
        """Have the functions that each element goes through move it; who calls puts them back."""
        package.eval_all = self._within(package.eval_all)
        package.handle_macro_call = self._within(package.handle_macro_call)
        package.reqd_attrs = self._at(package.reqd_attrs)

    def _within(self, original: Callable[..., Any]) -> Callable[..., Any]:
        """Behind an element the one around it goes on; an error leaves the cursor where it arose."""

        def go_through(element: Any, *rest: Any) -> Any:
            around, self.at = self.at, place_of(element)
            found = original(element, *rest)
            self.at = around
            return found

        return go_through

    def _at(self, original: Callable[..., Any]) -> Callable[..., Any]:
        """Wrap a function of xacro so that the element it reads becomes the current place."""

        def read(element: Any, *rest: Any) -> Any:
            self.at = place_of(element)
            return original(element, *rest)

        return read
