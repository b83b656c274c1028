"""Loads YAML of a file as plain data, in bounded time and memory.

A few lines of `&a [*b, *b]` can stand for billions of values, whoever goes through them.
"""

import re
from typing import Any

import yaml

MAX_VALUES = 500_000
"""Counted with aliases followed."""
_MAX_NODES = 250_000
"""Counted as written; each takes half a kilobyte while the text is read."""
_MAX_CHARACTERS = 16 * 1024 * 1024


class BoundedLoader(yaml.SafeLoader):
    """Plain data; what cannot be loaded is a YAMLError, whatever is wrong with it."""

    def __init__(self, stream: str) -> None:
        if len(stream) > _MAX_CHARACTERS:
            raise yaml.YAMLError(f"{len(stream)} characters of YAML; the most read is {_MAX_CHARACTERS}")
        super().__init__(stream)  # looks at every character
        self._nodes = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose a node, unless there are too many."""
        self._nodes += 1
        if self._nodes > _MAX_NODES:
            raise yaml.YAMLError(f"more than {_MAX_NODES} values")
        return super().compose_node(parent, index)

    def compose_scalar_node(self, anchor: Any) -> Any:
        """Compose a text or number; one with a lone `\\ud800` could be neither sent nor written."""
        node = super().compose_scalar_node(anchor)
        try:
            node.value.encode()
        except UnicodeEncodeError:
            line = node.start_mark.line + 1
            raise yaml.YAMLError(f"line {line}: a text with half of a surrogate pair, which no file can hold") from None
        return node

    def compose_document(self) -> Any:
        """Compose a document and count what its aliases stand for."""
        try:
            node = super().compose_document()
            if node is not None and _expanded_size(node, {}) > MAX_VALUES:
                raise yaml.YAMLError(f"its aliases stand for more than {MAX_VALUES} values")
        except RecursionError:
            raise yaml.YAMLError("nested too deeply") from None
        return node

    def construct_document(self, node: yaml.Node) -> Any:
        """Make the values."""
        try:
            return super().construct_document(node)
        except RecursionError:
            raise yaml.YAMLError("nested too deeply") from None
        except KeyError as error:  # `!!bool maybe`
            raise yaml.YAMLError(f"line {node.start_mark.line + 1}: {error} is not a value of its type") from None
        except (TypeError, AttributeError, ValueError) as error:  # an unhashable key, a month 13
            raise yaml.YAMLError(str(error)) from None


def load_yaml(text: str, loader: type[BoundedLoader] = BoundedLoader) -> Any:
    """Load one document.

    Raises:
        yaml.YAMLError: not YAML, too large, or no plain data.
    """
    return yaml.load(text, loader)


def one_line(error: yaml.YAMLError) -> str:
    """Say in one line what is wrong, and where."""
    if not isinstance(error, yaml.MarkedYAMLError):
        return re.sub(r"\s+", " ", str(error)).strip()
    mark = error.problem_mark or error.context_mark
    what = error.problem or error.context or "unreadable"
    return what if mark is None else f"line {mark.line + 1}, column {mark.column + 1}: {what}"


def _expanded_size(node: yaml.Node, known: dict[int, int]) -> int:
    """Count values with aliases followed; a node within itself is an error."""
    size = known.get(id(node))
    if size == 0:
        raise yaml.YAMLError(f"line {node.start_mark.line + 1}: a value contains itself")
    if size is not None:
        return size
    known[id(node)] = 0
    match node:
        case yaml.MappingNode(value=pairs):
            size = 1 + sum(_expanded_size(k, known) + _expanded_size(v, known) for k, v in pairs)
        case yaml.SequenceNode(value=items):
            size = 1 + sum(_expanded_size(item, known) for item in items)
        case _:
            size = 1
    known[id(node)] = size
    return size
