"""YAML with the line of each value."""

from collections.abc import Iterator
from typing import Any, NoReturn

import yaml

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.yaml_loader import BoundedLoader, one_line


class YamlNode:
    """Value of a YAML document, a mapping, a list or a scalar, with its source."""

    def __init__(self, node: yaml.Node, file: str, loader: BoundedLoader) -> None:
        self.at = Source(file, node.start_mark.line + 1)
        self.keys: dict[str, Source] = {}
        """Source of each key of a mapping."""
        self.value: Any = None
        """A dictionary or list of nodes, or a scalar."""
        match node:
            case yaml.MappingNode(value=pairs):
                self.value = {}
                for key, value in pairs:
                    name, at = str(loader.construct_object(key)), Source(file, key.start_mark.line + 1)
                    if name in self.value:
                        raise DescriptionError(at, f"{name!r} is here twice; keep one")
                    self.keys[name], self.value[name] = at, YamlNode(value, file, loader)
            case yaml.SequenceNode(value=items):
                self.value = [YamlNode(item, file, loader) for item in items]
            case _:
                self.value = loader.construct_object(node)

    def fail(self, message: str) -> NoReturn:
        """Raise an error at this value."""
        raise DescriptionError(self.at, message)

    def plain(self) -> Any:
        """Return the value without lines."""
        if isinstance(self.value, dict):
            return {key: value.plain() for key, value in self.value.items()}
        return [item.plain() for item in self.value] if isinstance(self.value, list) else self.value

    def mapping(self, label: str) -> "dict[str, YamlNode]":
        """Return a mapping's values.

        Raises:
            DescriptionError: not a mapping.
        """
        return self.value if isinstance(self.value, dict) else self.fail(f"{label} must be `name: value` lines")

    def check_keys(self, label: str, *allowed: str) -> "dict[str, YamlNode]":
        """Return a mapping's values.

        Raises:
            DescriptionError: not a mapping, or unknown keys.
        """
        values = self.mapping(label)
        for name in values:
            if name not in allowed:
                raise DescriptionError(self.keys[name], f"{label} has no {name!r}; it has: {', '.join(allowed)}")
        return values

    def items(self) -> "list[YamlNode]":
        """Return the values of a list; any other value counts as a list of one."""
        return self.value if isinstance(self.value, list) else [self]

    def number(self, label: str, *, above: float | None = None, minimum: float | None = None) -> float:
        """Return a number.

        Raises:
            DescriptionError: not a number, or too small.
        """
        value = as_number(self.value)
        if value is None:
            self.fail(f"{label} must be a number, not {self.plain()!r}")
        if (above is not None and not value > above) or (minimum is not None and not value >= minimum):
            bound = f"above {above:g}" if above is not None else f"at least {minimum:g}"
            self.fail(f"{label} must be {bound}, not {value:g}")
        return value

    def whole(self, label: str, *, minimum: int) -> int:
        """Return an integer.

        Raises:
            DescriptionError: not an integer, or too small.
        """
        if not isinstance(self.value, int) or isinstance(self.value, bool) or self.value < minimum:
            self.fail(f"{label} must be a whole number of at least {minimum}, not {self.plain()!r}")
        return self.value

    def flag(self, label: str) -> bool:
        """Return true or false.

        Raises:
            DescriptionError: another value.
        """
        return self.value if isinstance(self.value, bool) else self.fail(f"{label} must be true or false")

    def text(self, label: str) -> str:
        """Return a text, also of a number.

        Raises:
            DescriptionError: a list or mapping.
        """
        if isinstance(self.value, dict | list) or self.value is None:
            self.fail(f"{label} must be a text, not {self.plain()!r}")
        return self.value if isinstance(self.value, str) else repr(self.value)

    def texts(self, label: str) -> "Iterator[tuple[str, Source]]":
        """Yield the texts of a list, or the single text, each with its source."""
        for item in self.items():
            yield item.text(label), item.at


def as_number(value: object) -> float | None:
    """Return a number, also from text such as 1e-3, which YAML 1.1 does not read as a number; None if neither."""
    if isinstance(value, str):
        try:
            return float(value)
        except ValueError:
            return None
    return value if isinstance(value, int | float) and not isinstance(value, bool) else None


def read_yaml(text: str, file: str) -> YamlNode:
    """Read a document.

    Raises:
        DescriptionError: not YAML, empty, or too large.
    """
    try:
        loader = BoundedLoader(text)
        node = loader.get_single_node()
        if node is None:
            raise DescriptionError(Source(file, 1), "an empty file")
        return YamlNode(node, file, loader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        at = Source(file, None if mark is None else mark.line + 1)
        raise DescriptionError(at, f"not YAML: {one_line(error)}") from None
    except (ValueError, TypeError) as error:
        raise DescriptionError(Source(file), f"not YAML: {error}") from None
