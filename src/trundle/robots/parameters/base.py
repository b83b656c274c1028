"""Typed access to named settings, whatever they are written in."""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, Self, TypeVar

from trundle.base.diagnostics import UsageError
from trundle.spatial import Vector3

from . import values

_Value = TypeVar("_Value")


class ParamError(UsageError):
    """A parameter is missing or of no use; the text names it."""


class Parameters(ABC):
    """Named settings. A getter without a default raises ParamError where the setting is absent."""

    @abstractmethod
    def __contains__(self, name: str) -> bool:
        """Tell whether there is such a setting."""

    @abstractmethod
    def section(self, name: str) -> Self:
        """Settings within a setting; empty where there is none of that name."""

    @abstractmethod
    def sections(self, name: str) -> Sequence[Self]:
        """Each of several settings of one name as settings of its own."""

    @abstractmethod
    def texts(self, name: str) -> list[str]:
        """Each of several texts of one name; absent is empty."""

    def number(
        self, name: str, default: float | None = None, *, minimum: float = -math.inf, above: float = -math.inf
    ) -> float:
        """A finite number, not less than `minimum` and greater than `above`."""
        return self._read(name, default, lambda value: values.in_bounds(values.number(value), minimum, above))

    def integer(self, name: str, default: int | None = None, *, minimum: float = -math.inf) -> int:
        """A whole number; a fraction is cut off."""
        return self._read(
            name, default, lambda value: int(values.in_bounds(values.integer(value), minimum, above=-math.inf))
        )

    def flag(self, name: str, *, default: bool | None = None) -> bool:
        """A truth value."""
        return self._read(name, default, values.flag)

    def text(self, name: str, default: str | None = None) -> str:
        """A text."""
        return self._read(name, default, values.text)

    def numbers(self, name: str, count: int, default: Sequence[float] | None = None) -> Sequence[float]:
        """So many finite numbers."""
        return self._read(name, default, lambda value: values.numbers(value, count))

    def vector(self, name: str, default: Vector3 | None = None) -> Vector3:
        """Three finite numbers."""
        x, y, z = self.numbers(name, 3, default)
        return (x, y, z)

    def _read(self, name: str, default: _Value | None, parse: Callable[[Any], _Value]) -> _Value:
        value = self._find(name)
        if value is not None:
            try:
                return parse(value)
            except ValueError as error:
                self._refuse(name, str(error), default)
        if default is None:
            raise self._missing(name)
        return default

    @abstractmethod
    def _find(self, name: str) -> Any:
        """The setting as it is written; None: it is absent."""

    @abstractmethod
    def _refuse(self, name: str, what: str, default: object) -> None:
        """Handle a value of no use: raise, or warn that the default is used."""

    @abstractmethod
    def _missing(self, name: str) -> ParamError:
        """The error for a setting that is needed and absent."""
