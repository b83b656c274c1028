"""Base class of states."""

from .util import has_smach_interface

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from typing import Any


class State:
    """State that is executed, and ends with one of its outcomes."""

    def __init__(
        self,
        outcomes: "Iterable[str]" = (),
        input_keys: "Iterable[str]" = (),
        output_keys: "Iterable[str]" = (),
        io_keys: "Iterable[str]" = (),
    ) -> None:
        """Declare outcomes, and the keys of userdata that are read, written, or both."""
        self._outcomes = set(outcomes)
        self._input_keys = {*input_keys, *io_keys}
        self._output_keys = {*output_keys, *io_keys}
        self._preempt_requested = False

    def execute(self, ud: "Any") -> "Any":
        """Run, with userdata; returns an outcome."""
        raise NotImplementedError

    def register_outcomes(self, new_outcomes: "Iterable[str]") -> None:
        """Declare more outcomes."""
        self._outcomes = self._outcomes.union(new_outcomes)

    def get_registered_outcomes(self) -> tuple[str, ...]:
        """Outcomes declared."""
        return tuple(self._outcomes)

    def register_io_keys(self, keys: "Iterable[str]") -> None:
        """Declare more keys that are read and written."""
        self.register_input_keys(keys)
        self.register_output_keys(keys)

    def register_input_keys(self, keys: "Iterable[str]") -> None:
        """Declare more keys that are read."""
        self._input_keys = self._input_keys.union(keys)

    def get_registered_input_keys(self) -> tuple[str, ...]:
        """Keys that are read."""
        return tuple(self._input_keys)

    def register_output_keys(self, keys: "Iterable[str]") -> None:
        """Declare more keys that are written."""
        self._output_keys = self._output_keys.union(keys)

    def get_registered_output_keys(self) -> tuple[str, ...]:
        """Keys that are written."""
        return tuple(self._output_keys)

    def request_preempt(self) -> None:
        """Request that the state end soon."""
        self._preempt_requested = True

    def service_preempt(self) -> None:
        """Confirm that the preempt request is serviced."""
        self._preempt_requested = False

    def recall_preempt(self) -> None:
        """Withdraw the preempt request."""
        self._preempt_requested = False

    def preempt_requested(self) -> bool:
        """True if the state should end soon."""
        return self._preempt_requested


class CBState(State):
    """State that calls a function, which takes userdata and returns an outcome."""

    def __init__(
        self,
        cb: "Callable[..., Any]",
        cb_args: "Iterable[Any]" = (),
        cb_kwargs: "Mapping[str, Any] | None" = None,
        outcomes: "Iterable[str]" = (),
        input_keys: "Iterable[str]" = (),
        output_keys: "Iterable[str]" = (),
        io_keys: "Iterable[str]" = (),
    ) -> None:
        """Wrap a function, with the keys and outcomes that its `cb_interface` declares."""
        super().__init__(outcomes, input_keys, output_keys, io_keys)
        self._cb = cb
        self._cb_args = cb_args
        self._cb_kwargs = cb_kwargs or {}
        if has_smach_interface(cb):
            interface: Any = cb
            self.register_input_keys(interface.get_registered_input_keys())
            self.register_output_keys(interface.get_registered_output_keys())
            self.register_outcomes(interface.get_registered_outcomes())

    def execute(self, ud: "Any") -> "Any":
        """Call the function."""
        return self._cb(ud, *self._cb_args, **self._cb_kwargs)
