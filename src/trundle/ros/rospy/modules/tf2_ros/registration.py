"""Functions that transform and convert data types, registered by the packages that know the types."""

from copy import deepcopy
from typing import ClassVar


class TypeException(Exception):
    """No function is registered for a type."""

    def __init__(self, errstr):
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):
    """A method that a subclass has to define."""

    def __init__(self):
        super().__init__("CanTransform or LookupTransform not implemented")


def _look_up(table, key):
    if key not in table:
        raise TypeException(f"Type {key} if not loaded or supported")
    return table[key]


class TransformRegistration:
    """Type → function(object, TransformStamped) that transforms it; one table for all instances."""

    _functions: ClassVar[dict] = {}

    def print_me(self):
        """Print the table."""
        print(self._functions)

    def add(self, key, callback):
        """Register a type's function."""
        self._functions[key] = callback

    def get(self, key):
        """Function of a type.

        Raises:
            TypeException: none is registered; import the package that has it, as `tf2_geometry_msgs`.
        """
        return _look_up(self._functions, key)


class ConvertRegistration:
    """Functions between a type and its message; one table for all instances."""

    _to_msg: ClassVar[dict] = {}
    _from_msg: ClassVar[dict] = {}
    _convert: ClassVar[dict] = {}

    def add_from_msg(self, key, callback):
        """Register how a type is made of its message."""
        self._from_msg[key] = callback

    def add_to_msg(self, key, callback):
        """Register how a type becomes its message."""
        self._to_msg[key] = callback

    def add_convert(self, key, callback):
        """Register a direct conversion for the pair (from type, to type)."""
        self._convert[key] = callback

    def get_from_msg(self, key):
        """See `add_from_msg`; TypeException if there is none."""
        return _look_up(self._from_msg, key)

    def get_to_msg(self, key):
        """See `add_to_msg`; TypeException if there is none."""
        return _look_up(self._to_msg, key)

    def get_convert(self, key):
        """See `add_convert`; TypeException if there is none."""
        return _look_up(self._convert, key)


def convert(a, b_type):
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
