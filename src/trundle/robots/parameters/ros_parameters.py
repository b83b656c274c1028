"""Parameters of the ROS graph, read once from the parameter server."""

from collections.abc import Callable, Mapping
from types import NoneType
from typing import Any, Self, cast

from .base import ParamError, Parameters


class RosParameters(Parameters):
    """Parameters of a namespace; an invalid value raises ParamError, or is replaced by its default with a warning."""

    def __init__(self, tree: object, namespace: str, *, warn: Callable[[str], None] | None = None) -> None:
        """Wrap parameters.

        Args:
            tree: parameters, empty if it is not a mapping.
            namespace: global name of the namespace.
            warn: called with a sentence for each invalid value that has a default; None: ParamError.
        """
        self._tree: Mapping[str, Any] = tree if isinstance(tree, Mapping) else {}
        self.namespace = namespace.rstrip("/")
        self._warn = warn

    def __contains__(self, name: str) -> bool:
        """True if the namespace has the parameter."""
        return self._tree.get(name) is not None

    def names(self) -> list[str]:
        """Return the names of the parameters directly in the namespace, in order."""
        return list(self._tree)

    def tree(self) -> dict[str, Any]:
        """Return the parameters as they are."""
        return dict(self._tree)

    def section(self, name: str) -> Self:
        """Return a nested namespace."""
        return type(self)(self._tree.get(name), f"{self.namespace}/{name}", warn=self._warn)

    def renamed(self, names: Mapping[str, str]) -> Self:
        """Return the namespace with parameters under their new names, too, unless these are set; `names`: old → new."""
        tree = self._tree
        found = {new: tree[old] for old, new in names.items() if old in tree}
        return type(self)({**found, **tree}, self.namespace, warn=self._warn)

    def with_defaults(self, values: Mapping[str, object]) -> Self:
        """Return the namespace with values for parameters that are not set."""
        return type(self)({**values, **self._tree}, self.namespace, warn=self._warn)

    def clamped(self, name: str, value: float, lower: float, upper: float) -> float:
        """Return a parameter's value, or the nearest within bounds, with a warning or as ParamError."""
        nearest = type(value)(min(max(value, lower), upper))
        if nearest != value:
            limit = f" must be ≥ {lower:g}" if value < lower else f" must be ≤ {upper:g}"
            self._reject(name, f"{limit}, got {value:g}", nearest)
        return nearest

    def sections(self, name: str) -> list[Self]:
        """Return the dictionaries of a list parameter."""
        space = f"{self.namespace}/{name}"
        return [type(self)(item, f"{space}[{i}]", warn=self._warn) for i, item in enumerate(self.items(name))]

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
        problem = f"{self._label(name)}{message}"
        if self._warn is None or default is None:
            raise ParamError(problem)
        self._warn(f"{problem}; {default!r} is used")

    def _missing(self, name: str) -> ParamError:
        return ParamError(f"{self._label(name)} is not set")

    def _label(self, name: str) -> str:
        return f"parameter {self.namespace}/{name}"
