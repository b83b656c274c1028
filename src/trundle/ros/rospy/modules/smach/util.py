"""Shutdown check, and callbacks that declare their keys."""

_check = [lambda: False]


def is_shutdown():
    """True if the program ends; smach_ros sets rospy's function."""
    return _check[0]()


def set_shutdown_check(cb):
    """Replace the function that is asked."""
    _check[0] = cb


def has_smach_interface(obj):
    """True if an object declares outcomes and keys."""
    names = ("get_registered_input_keys", "get_registered_output_keys", "get_registered_outcomes")
    return all(hasattr(obj, name) for name in names)


class CBInterface:
    """A function with declared outcomes and keys."""

    def __init__(self, cb, outcomes=(), input_keys=(), output_keys=(), io_keys=()):
        self._cb = cb
        self._outcomes = tuple(outcomes)
        self._input_keys = {*input_keys, *io_keys}
        self._output_keys = {*output_keys, *io_keys}

    def __call__(self, *args, **kwargs):
        return self._cb(*args, **kwargs)

    def get_registered_input_keys(self):
        """Keys that it reads."""
        return tuple(self._input_keys)

    def get_registered_output_keys(self):
        """Keys that it writes."""
        return tuple(self._output_keys)

    def get_registered_outcomes(self):
        """Outcomes that it may return."""
        return self._outcomes


class cb_interface:
    """Decorator that makes a CBInterface of a function."""

    def __init__(self, outcomes=(), input_keys=(), output_keys=()):
        self._declared = (outcomes or (), input_keys or (), output_keys or ())

    def __call__(self, cb):
        return CBInterface(cb, *self._declared)
