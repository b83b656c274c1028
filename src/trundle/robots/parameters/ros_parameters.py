"""Parameters of the ROS graph, read once from the parameter server."""

from collections.abc import Mapping
from types import NoneType
from typing import Any, Self, cast

from .base import ParamError, Parameters


class RosParameters(Parameters):
    """A namespace of parameters; a value of no use raises ParamError."""

    def __init__(self, tree: object, where: str) -> None:
        """Name the namespace globally in messages, by `where`; a tree that is not a mapping counts as empty."""
        self._tree: Mapping[str, Any] = tree if isinstance(tree, Mapping) else {}
        self.where = where.rstrip("/")

    def __contains__(self, name: str) -> bool:
        """Tell whether the namespace has the parameter."""
        return self._tree.get(name) is not None

    def names(self) -> list[str]:
        """The parameters directly in here, in order."""
        return list(self._tree)

    def section(self, name: str) -> Self:
        """A namespace within."""
        return type(self)(self._tree.get(name), f"{self.where}/{name}")

    def sections(self, name: str) -> list[Self]:
        """The dictionaries of a list."""
        return [type(self)(item, f"{self.where}/{name}[{i}]") for i, item in enumerate(self.items(name))]

    def texts(self, name: str) -> list[str]:
        """A list of texts; absent is empty."""
        texts = self.items(name)
        if not all(isinstance(text, str) for text in texts):
            raise ParamError(f"{self._label(name)}: {texts!r} is not a list of texts")
        return texts

    def items(self, name: str) -> list[Any]:
        """A list of any values; absent is empty."""
        value = self._tree.get(name)
        if not isinstance(value, list | NoneType):
            raise ParamError(f"{self._label(name)}: {value!r} is not a list")
        return cast("list[Any]", value or [])

    def _find(self, name: str) -> Any:
        return self._tree.get(name)

    def _refuse(self, name: str, what: str, default: object) -> None:
        del default
        raise ParamError(f"{self._label(name)}{what}")

    def _missing(self, name: str) -> ParamError:
        return ParamError(f"{self._label(name)} is not set")

    def _label(self, name: str) -> str:
        return f"parameter {self.where}/{name}"
