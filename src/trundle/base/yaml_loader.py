"""Loader of YAML as plain data, in bounded time and memory.

A few lines of `&a [*b, *b]` can expand to billions of values.
"""

import re
from collections.abc import Callable
from typing import Any

import yaml

MAX_VALUES = 500_000
"""Maximum number of values with aliases expanded."""
_MAX_NODES = 250_000
"""Maximum number of nodes as written; each takes half a kilobyte while reading."""
_MAX_OTHER_KEYS = 2_000
"""Maximum number of keys of one mapping that are not text: a file can choose them so that their hashes collide."""
_MAX_CHARACTERS = 16 * 1024 * 1024


class BoundedLoader(yaml.SafeLoader):
    """Loader of plain data; every error is a YAMLError."""

    def __init__(self, stream: str, count: Callable[[int], None] | None = None) -> None:
        """Load a text; `count` is called with the number of further values, as written and as aliases."""
        if len(stream) > _MAX_CHARACTERS:
            raise yaml.YAMLError(f"{len(stream)} characters of YAML; the most read is {_MAX_CHARACTERS}")
        super().__init__(stream)  # PyYAML checks every character
        self._nodes = 0
        self._count = count

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose a node, up to the limit."""
        self._nodes += 1
        if self._nodes > _MAX_NODES:
            raise yaml.YAMLError(f"more than {_MAX_NODES} values")
        if self._count is not None:
            self._count(1)
        return super().compose_node(parent, index)

    def compose_scalar_node(self, anchor: Any) -> Any:
        r"""Compose a scalar; refuse a lone `\ud800`, which could be neither sent nor written."""
        node = super().compose_scalar_node(anchor)
        try:
            node.value.encode()
        except UnicodeEncodeError:
            line = node.start_mark.line + 1
            raise yaml.YAMLError(f"line {line}: a text with half of a surrogate pair, which no file can hold") from None
        return node

    def compose_document(self) -> Any:
        """Compose a document, with a limit on expanded aliases."""
        try:
            node = super().compose_document()
            size = 0 if node is None else _expanded_size(node, {})
            if size > MAX_VALUES:
                raise yaml.YAMLError(f"its aliases stand for more than {MAX_VALUES} values")
            if self._count is not None:
                self._count(max(size - self._nodes, 0))
        except RecursionError:
            raise yaml.YAMLError("nested too deeply") from None
        return node

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        """Construct a mapping, with a limit on keys that are not text."""
        other_keys = sum(key.tag != "tag:yaml.org,2002:str" for key, _ in node.value)
        if other_keys > _MAX_OTHER_KEYS:
            line = node.start_mark.line + 1
            raise yaml.YAMLError(f"line {line}: more than {_MAX_OTHER_KEYS} keys of a mapping that are not text")
        return super().construct_mapping(node, deep)

    def construct_document(self, node: yaml.Node) -> object:
        """Construct the values."""
        try:
            return super().construct_document(node)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        except RecursionError:
            raise yaml.YAMLError("nested too deeply") from None
        except KeyError as error:  # `!!bool maybe`
            raise yaml.YAMLError(f"line {node.start_mark.line + 1}: {error} is not a value of its type") from None
        except (TypeError, AttributeError, ValueError) as error:  # such as an unhashable key, or a month 13
            raise yaml.YAMLError(str(error)) from None


def load_yaml(
    text: str, loader: type[BoundedLoader] = BoundedLoader, count: Callable[[int], None] | None = None
) -> object:
    """Load one document; see `BoundedLoader` for `count`.

    Raises:
        yaml.YAMLError: not YAML, too large, or not plain data.
    """
    document = loader(text, count)
    try:
        return document.get_single_data()
    finally:
        document.dispose()  # pyright: ignore[reportUnknownMemberType]


def one_line(error: yaml.YAMLError) -> str:
    """Return the error and its position on one line."""
    if not isinstance(error, yaml.MarkedYAMLError):
        return re.sub(r"\s+", " ", str(error)).strip()
    mark = error.problem_mark or error.context_mark
    problem = error.problem or error.context or "unreadable"
    return problem if mark is None else f"line {mark.line + 1}, column {mark.column + 1}: {problem}"


def _expanded_size(node: yaml.Node, sizes: dict[int, int]) -> int:
    """Count values with aliases expanded; a node that contains itself is an error."""
    size = sizes.get(id(node))
    if size == 0:
        raise yaml.YAMLError(f"line {node.start_mark.line + 1}: a value contains itself")
    if size is not None:
        return size
    sizes[id(node)] = 0
    match node:
        case yaml.MappingNode(value=pairs):
            size = 1 + sum(_expanded_size(k, sizes) + _expanded_size(v, sizes) for k, v in pairs)
        case yaml.SequenceNode(value=items):
            size = 1 + sum(_expanded_size(item, sizes) for item in items)
        case _:
            size = 1
    sizes[id(node)] = size
    return size
