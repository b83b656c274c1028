"""Typed access to named parameters, independent of their source."""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, Self, TypeVar

from trundle.base.diagnostics import UsageError
from trundle.spatial import Vector3

from . import values

_Value = TypeVar("_Value")


class ParamError(UsageError):
    """Missing or invalid parameter; the message names it."""

    id = "plugin-parameter"


class Parameters(ABC):
    """Named parameters; a getter without a default raises ParamError if the parameter is absent."""

    @abstractmethod
    def __contains__(self, name: str) -> bool:
        """True if the parameter exists."""

    @abstractmethod
    def section(self, name: str) -> Self:
        """Return the parameters nested in a parameter; empty if it is absent."""

    @abstractmethod
    def sections(self, name: str) -> Sequence[Self]:
        """Return the nested parameters of each parameter of one name."""

    @abstractmethod
    def texts(self, name: str) -> list[str]:
        """Return the texts of all parameters of one name; empty if absent."""

    def number(
        self, name: str, default: float | None = None, *, minimum: float = -math.inf, above: float = -math.inf
    ) -> float:
        """Return a finite number ≥ `minimum` and > `above`."""
        return self._read(name, default, lambda value: values.in_bounds(values.number(value), minimum, above))

    def integer(self, name: str, default: int | None = None, *, minimum: float = -math.inf) -> int:
        """Return an integer; a fraction is truncated."""
        return self._read(
            name, default, lambda value: int(values.in_bounds(values.integer(value), minimum, above=-math.inf))
        )

    def flag(self, name: str, *, default: bool | None = None) -> bool:
        """Return a boolean."""
        return self._read(name, default, values.flag)

    def text(self, name: str, default: str | None = None) -> str:
        """Return a text."""
        return self._read(name, default, values.text)

    def numbers(self, name: str, count: int, default: Sequence[float] | None = None) -> Sequence[float]:
        """Return `count` finite numbers."""
        return self._read(name, default, lambda value: values.numbers(value, count))

    def vector(self, name: str, default: Vector3 | None = None) -> Vector3:
        """Return three finite numbers."""
        x, y, z = self.numbers(name, 3, default)
        return (x, y, z)

    def _read(self, name: str, default: _Value | None, parse: Callable[[Any], _Value]) -> _Value:
        value = self._find(name)
        if value is not None:
            try:
                return parse(value)
            except ValueError as error:
                self._reject(name, str(error), default)
        if default is None:
            raise self._missing(name)
        return default

    @abstractmethod
    def _find(self, name: str) -> Any:
        """Return the unparsed value; None if absent."""

    @abstractmethod
    def _reject(self, name: str, message: str, default: object) -> None:
        """Handle an invalid value: raise, or warn that the default is used."""

    @abstractmethod
    def _missing(self, name: str) -> ParamError:
        """Return the error for a missing required parameter."""
