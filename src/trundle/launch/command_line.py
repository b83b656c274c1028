"""Arguments that the command line gives a launch."""

import re
from collections.abc import Iterator, Mapping

from trundle.diagnostics import DescriptionError
from trundle.xmlnode import XmlNode


class CommandLine:
    """`name:=value` words, and the files that see them: those it names, and what these include with pass_all_args."""

    def __init__(self, arguments: Mapping[str, str]) -> None:
        self.arguments = arguments
        self._files: list[XmlNode] = []

    def shown_to(self, root: XmlNode) -> None:
        """Have a file see the arguments."""
        self._files.append(root)

    def refuse_unknown(self) -> None:
        """Refuse an argument that no file declares or uses; roslaunch lets a misspelt one do nothing in silence.

        Raises:
            DescriptionError: with the arguments there are.
        """
        known = {name for root in self._files for name in _declared(root)}
        for name in sorted(set(self.arguments) - known):
            use = re.compile(rf"\$\(\s*arg\s+{re.escape(name)}\s*\)|\$\(eval\b.*\b{re.escape(name)}\b", re.DOTALL)
            if self._files and not any(use.search(text) for root in self._files for text in _texts(root)):
                there_is = ", ".join(map(repr, sorted(known))) or "none"
                raise DescriptionError(
                    self._files[0].at, f"no argument {name!r} to set; the file's arguments: {there_is}"
                )


def _declared(node: XmlNode) -> Iterator[str]:
    """Names of a file's <arg>s, whether or not their `if` holds; those in an <include> are another file's."""
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
