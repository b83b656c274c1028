"""A node's parameters, read once and checked; what is wrong with one is said in a sentence."""

import math
from collections.abc import Mapping
from typing import Any, cast

from trundle.diagnostics import TrundleError


class ParamError(TrundleError):
    """A parameter is missing or of no use; the text names it."""


class NodeParams:
    """A namespace of parameters."""

    def __init__(self, tree: object, where: str) -> None:
        """`where` is the namespace's global name, for messages; anything but a mapping counts as empty."""
        self._tree: Mapping[str, Any] = tree if isinstance(tree, Mapping) else {}
        self.where = where.rstrip("/")

    def names(self) -> list[str]:
        """What is set directly in here, in order."""
        return list(self._tree)

    def section(self, name: str) -> "NodeParams":
        """A namespace within."""
        return NodeParams(self._tree.get(name), f"{self.where}/{name}")

    def number(self, name: str, default: float | None = None) -> float:
        """A finite number.

        Raises:
            ParamError: not a number, or absent without a default.
        """
        value = self._get(name, default)
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            try:
                value = float(value) if isinstance(value, str) else math.nan
            except ValueError:
                value = math.nan
            if not math.isfinite(value):
                raise ParamError(f"parameter {self.where}/{name}: {self._tree.get(name)!r} is not a number")
        return float(value)

    def rate_hz(self, name: str, default: float | None = None) -> float:
        """A number greater than zero."""
        value = self.number(name, default)
        if value <= 0.0:
            raise ParamError(f"parameter {self.where}/{name}: a rate is > 0 Hz, got {value:g}")
        return value

    def flag(self, name: str, *, default: bool) -> bool:
        """A truth value; numbers count as Python counts them."""
        value = self._get(name, default)
        if isinstance(value, bool | int | float):
            return bool(value)
        raise ParamError(f"parameter {self.where}/{name}: {value!r} is neither true nor false")

    def text(self, name: str, default: str | None = None) -> str:
        """A text."""
        value = self._get(name, default)
        if not isinstance(value, str):
            raise ParamError(f"parameter {self.where}/{name}: {value!r} is not a text")
        return value

    def texts(self, name: str) -> list[str]:
        """A list of texts; absent is empty."""
        value = self._tree.get(name, [])
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise ParamError(f"parameter {self.where}/{name}: {value!r} is not a list of texts")
        return value

    def items(self, name: str) -> list[Any]:
        """A list of anything; absent is empty."""
        value = self._tree.get(name, [])
        if not isinstance(value, list):
            raise ParamError(f"parameter {self.where}/{name}: {value!r} is not a list")
        return cast("list[Any]", value)

    def _get(self, name: str, default: Any) -> Any:
        value = self._tree.get(name, default)
        if value is None:
            raise ParamError(f"parameter {self.where}/{name} is not set")
        return value
