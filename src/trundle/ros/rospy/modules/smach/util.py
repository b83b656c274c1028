"""Shutdown check, and callbacks that declare their outcomes and keys."""

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import Any

_check: "list[Callable[[], bool]]" = [lambda: False]


def is_shutdown() -> bool:
    """True if the program is shutting down; smach_ros sets rospy's function."""
    return _check[0]()


def set_shutdown_check(cb: "Callable[[], bool]") -> None:
    """Replace the function that checks for shutdown."""
    _check[0] = cb


def has_smach_interface(obj: object) -> bool:
    """True if an object declares outcomes and keys."""
    names = ("get_registered_input_keys", "get_registered_output_keys", "get_registered_outcomes")
    return all(hasattr(obj, name) for name in names)


class CBInterface:
    """A function with declared outcomes and keys."""

    def __init__(
        self,
        cb: "Callable[..., Any]",
        outcomes: "Iterable[str]" = (),
        input_keys: "Iterable[str]" = (),
        output_keys: "Iterable[str]" = (),
        io_keys: "Iterable[str]" = (),
    ) -> None:
        self._cb = cb
        self._outcomes = tuple(outcomes)
        self._input_keys = {*input_keys, *io_keys}
        self._output_keys = {*output_keys, *io_keys}

    def __call__(self, *args: "Any", **kwargs: "Any") -> "Any":
        return self._cb(*args, **kwargs)

    def get_registered_input_keys(self) -> tuple[str, ...]:
        """Keys that it reads."""
        return tuple(self._input_keys)

    def get_registered_output_keys(self) -> tuple[str, ...]:
        """Keys that it writes."""
        return tuple(self._output_keys)

    def get_registered_outcomes(self) -> tuple[str, ...]:
        """Outcomes that it may return."""
        return self._outcomes


class cb_interface:
    """Decorator that wraps a function in a CBInterface."""

    def __init__(
        self, outcomes: "Iterable[str]" = (), input_keys: "Iterable[str]" = (), output_keys: "Iterable[str]" = ()
    ) -> None:
        self._declared = (outcomes or (), input_keys or (), output_keys or ())

    def __call__(self, cb: "Callable[..., Any]") -> CBInterface:
        return CBInterface(cb, *self._declared)
