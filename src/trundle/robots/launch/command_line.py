"""Command-line arguments of a launch."""

import re
from collections.abc import Iterable, Iterator, Mapping

from trundle.base.diagnostics import UnknownArgumentError, nearest
from trundle.base.xmlnode import XmlNode

_USE = re.compile(r"""\$\(\s*arg\s+([^\s)]+)\s*\)|\barg\(\s*['"]([^'"]+)['"]\s*\)""")


class CommandLine:
    """`name:=value` arguments, and the files to which they apply: launched files, and includes with pass_all_args."""

    def __init__(self, arguments: Mapping[str, str]) -> None:
        self.arguments = arguments
        self._files: list[XmlNode] = []

    def apply_to(self, root: XmlNode) -> None:
        """Register a file to which the arguments apply."""
        self._files.append(root)

    def check_unused(self) -> None:
        """Reject arguments that no file declares or uses; roslaunch silently ignores misspelt ones.

        Raises:
            UnknownArgumentError: an argument is unknown; the message names the closest match and all arguments.
        """
        texts = [text for root in self._files for text in _texts(root)]
        known = {name for root in self._files for name in _declared(root)} | set(_used(texts))
        for name in sorted(set(self.arguments) - known) if self._files else ():
            if not any(re.search(rf"\$\(eval\b.*\b{re.escape(name)}\b", text, re.DOTALL) for text in texts):
                suggestion = nearest(name, known) if len(known) > 1 else None
                hint = f"; the nearest is {suggestion!r}" if suggestion else ""
                names = ", ".join(map(repr, sorted(known))) or "none"
                message = f"no argument {name!r} to set{hint}; the file's arguments: {names}"
                raise UnknownArgumentError(self._files[0].at, message, "unknown-argument", name=name)


def _used(texts: Iterable[str]) -> Iterator[str]:
    """Names in $(arg …) and in arg(…) of expressions, declared or not."""
    for text in texts:
        for match in _USE.finditer(text):
            yield match[1] or match[2]


def _declared(node: XmlNode) -> Iterator[str]:
    """Names of a file's <arg>s, whatever their `if`; those in an <include> belong to the included file."""
    if node.tag == "arg" and (name := node.attribute("name")):
        yield name
    for child in node.children if node.tag != "include" else ():
        yield from _declared(child)


def _texts(node: XmlNode) -> Iterator[str]:
    for name in node.attributes():
        yield node.attribute(name) or ""
    yield node.raw_text
    for child in node.children:
        yield from _texts(child)
