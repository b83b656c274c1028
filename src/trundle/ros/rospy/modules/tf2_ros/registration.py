"""Functions that transform and convert data types, registered by the packages that define them."""

from collections.abc import Callable
from copy import deepcopy
from typing import Any, ClassVar, TypeVar

_T = TypeVar("_T")
_Function = Callable[..., Any]
_Table = dict[Any, _Function]


class TypeException(Exception):
    """No function is registered for a type."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):
    """A method that a subclass has to define."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


def _look_up(table: _Table, key: Any) -> _Function:
    if key not in table:
        raise TypeException(f"Type {key} if not loaded or supported")
    return table[key]


class TransformRegistration:
    """Type → function(object, TransformStamped) that transforms it; one table for all instances."""

    _functions: ClassVar[_Table] = {}

    def print_me(self) -> None:
        """Print the table."""
        print(self._functions)

    def add(self, key: Any, callback: _Function) -> None:
        """Register a type's function."""
        self._functions[key] = callback

    def get(self, key: Any) -> _Function:
        """Function of a type.

        Raises:
            TypeException: none is registered; import the package that registers it, such as `tf2_geometry_msgs`.
        """
        return _look_up(self._functions, key)


class ConvertRegistration:
    """Functions between a type and its message; one table for all instances."""

    _to_msg: ClassVar[_Table] = {}
    _from_msg: ClassVar[_Table] = {}
    _convert: ClassVar[_Table] = {}

    def add_from_msg(self, key: Any, callback: _Function) -> None:
        """Register the function that converts a message to a type."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: _Function) -> None:
        """Register the function that converts a type to its message."""
        self._to_msg[key] = callback

    def add_convert(self, key: Any, callback: _Function) -> None:
        """Register a direct conversion for the pair (from type, to type)."""
        self._convert[key] = callback

    def get_from_msg(self, key: Any) -> _Function:
        """See `add_from_msg`; TypeException if there is none."""
        return _look_up(self._from_msg, key)

    def get_to_msg(self, key: Any) -> _Function:
        """See `add_to_msg`; TypeException if there is none."""
        return _look_up(self._to_msg, key)

    def get_convert(self, key: Any) -> _Function:
        """See `add_convert`; TypeException if there is none."""
        return _look_up(self._convert, key)


def convert(a: object, b_type: type[_T]) -> _T:
    """Convert to a type: directly, as a copy, or over messages.

    Raises:
        TypeException: no such conversion is registered.
    """
    registration = ConvertRegistration()
    try:
        return registration.get_convert((type(a), b_type))(a)
    except TypeException:
        if type(a) is b_type:
            return deepcopy(a)
    return registration.get_from_msg(b_type)(registration.get_to_msg(type(a))(a))
