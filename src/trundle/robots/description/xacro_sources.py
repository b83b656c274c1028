"""Source positions of xacro elements, and of the expansion in progress."""

import xml.dom.expatbuilder
from collections.abc import Callable
from typing import Any

from trundle.base.diagnostics import Source
from trundle.base.xmlnode import ReadBudget

_AT = "at"


class _SourceCopier:
    """Copies an element's position to its clones, and counts them."""

    def __init__(self, budget: ReadBudget) -> None:
        self._budget = budget

    def handle(self, operation: int, key: str, data: Any, src: Any, dst: Any) -> None:
        """Implement the DOM's UserDataHandler; `dst` is None when an element is deleted."""
        del operation
        if dst is not None:
            dst.setUserData(key, data, self)
            self._budget.add_nodes(1 + src.attributes.length + len(src.childNodes), data)


class _SourceBuilder(xml.dom.expatbuilder.ExpatBuilderNS):
    """Builder of a document with source positions."""

    def __init__(self, file: str, first_line: int, budget: ReadBudget) -> None:
        super().__init__()
        self._budget, self._copier = budget, _SourceCopier(budget)
        self._file = file
        self._first_line = first_line

    def start_element_handler(self, name: Any, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        line = self.getParser().CurrentLineNumber + self._first_line
        at = Source(self._file, line)
        self.curNode.setUserData(_AT, at, self._copier)
        self._budget.add_nodes(1 + len(attributes) // 2, at)

    def comment_handler(self, data: Any) -> None:
        super().comment_handler(data)
        self._budget.add_nodes(1, Source(self._file))

    def pi_handler(self, target: Any, data: Any) -> None:
        super().pi_handler(target, data)
        self._budget.add_nodes(1, Source(self._file))

    def end_cdata_section_handler(self) -> None:
        super().end_cdata_section_handler()
        self._budget.add_nodes(1, Source(self._file))


def parse_with_lines(data: bytes, file: str, budget: ReadBudget) -> object:
    """Parse a file, which may start with blank lines; `source_of` returns the position of its elements.

    Raises:
        ExpatError: it is not well-formed.
        ReadBudgetError: the budget, which also counts the elements' clones, is exhausted.
    """
    document = data.lstrip()
    return _SourceBuilder(file, data[: len(data) - len(document)].count(b"\n"), budget).parseString(document)


def source_of(element: Any) -> Source:
    """Return the source position of an element, or of its original."""
    return element.getUserData(_AT)


class Cursor:
    """Current source position of the expansion."""

    def __init__(self, at: Source) -> None:
        self.at = at

    def follow(self, package: Any) -> None:
        """Patch the functions that process elements to update the position; the caller restores them."""
        package.eval_all = self._within(package.eval_all)
        package.handle_macro_call = self._within(package.handle_macro_call)
        package.reqd_attrs = self._at(package.reqd_attrs)

    def _within(self, original: Callable[..., Any]) -> Callable[..., Any]:
        """Wrap a function to restore the position after an element; an error leaves it at the element."""

        def process(element: Any, *rest: Any) -> Any:
            previous, self.at = self.at, source_of(element)
            result = original(element, *rest)
            self.at = previous
            return result

        return process

    def _at(self, original: Callable[..., Any]) -> Callable[..., Any]:
        """Wrap a function to make the element that it reads the current position."""

        def read(element: Any, *rest: Any) -> Any:
            self.at = source_of(element)
            return original(element, *rest)

        return read
