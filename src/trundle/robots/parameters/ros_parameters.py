"""Parameters of the ROS graph, read once from the parameter server."""

from collections.abc import Mapping
from types import NoneType
from typing import Any, Self, cast

from .base import ParamError, Parameters


class RosParameters(Parameters):
    """Parameters of a namespace; an invalid value raises ParamError."""

    def __init__(self, tree: object, namespace: str) -> None:
        """Wrap a tree of parameters, empty if it is not a mapping; `namespace` is its global name."""
        self._tree: Mapping[str, Any] = tree if isinstance(tree, Mapping) else {}
        self.namespace = namespace.rstrip("/")

    def __contains__(self, name: str) -> bool:
        """True if the namespace has the parameter."""
        return self._tree.get(name) is not None

    def names(self) -> list[str]:
        """Return the names of the parameters directly in the namespace, in order."""
        return list(self._tree)

    def section(self, name: str) -> Self:
        """Return a nested namespace."""
        return type(self)(self._tree.get(name), f"{self.namespace}/{name}")

    def renamed(self, names: Mapping[str, str]) -> Self:
        """Return the namespace with parameters by new names as well, unless those are set; `names` are old → new."""
        tree = self._tree
        return type(self)({**{new: tree[old] for old, new in names.items() if old in tree}, **tree}, self.namespace)

    def with_defaults(self, values: Mapping[str, object]) -> Self:
        """Return the namespace with values for parameters that are not set."""
        return type(self)({**values, **self._tree}, self.namespace)

    def sections(self, name: str) -> list[Self]:
        """Return the dictionaries of a list parameter."""
        return [type(self)(item, f"{self.namespace}/{name}[{i}]") for i, item in enumerate(self.items(name))]

    def texts(self, name: str) -> list[str]:
        """Return a list of texts; empty if absent."""
        texts = self.items(name)
        if not all(isinstance(text, str) for text in texts):
            raise ParamError(f"{self._label(name)}: {texts!r} is not a list of texts")
        return texts

    def items(self, name: str) -> list[Any]:
        """Return a list of any values; empty if absent."""
        value = self._tree.get(name)
        if not isinstance(value, list | NoneType):
            raise ParamError(f"{self._label(name)}: {value!r} is not a list")
        return cast("list[Any]", value or [])

    def _find(self, name: str) -> Any:
        return self._tree.get(name)

    def _reject(self, name: str, message: str, default: object) -> None:
        del default
        raise ParamError(f"{self._label(name)}{message}")

    def _missing(self, name: str) -> ParamError:
        return ParamError(f"{self._label(name)} is not set")

    def _label(self, name: str) -> str:
        return f"parameter {self.namespace}/{name}"
