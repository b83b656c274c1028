"""Base class of states that contain states."""

import threading
import traceback
from contextlib import contextmanager

from .exceptions import InvalidConstructionError, InvalidStateError, InvalidTransitionError
from .log import logerr, logwarn
from .state import State
from .user_data import UserData

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable
    from types import TracebackType
    from typing import Any, Self

    _Callback = tuple[Callable[..., object], Iterable[Any]]


class Container(State):
    """State that contains states, added while it is open: `with container: …`."""

    _construction_stack: "list[Container]" = []
    _construction_lock = threading.RLock()
    _context_kwargs: "dict[str, Any]" = {}

    def __init__(
        self, outcomes: "Iterable[str]" = (), input_keys: "Iterable[str]" = (), output_keys: "Iterable[str]" = ()
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self.userdata = UserData()
        self._start_cbs: list[_Callback] = []
        self._transition_cbs: list[_Callback] = []
        self._termination_cbs: list[_Callback] = []

    def __getitem__(self, key: str) -> State:
        raise NotImplementedError

    def get_children(self) -> dict[str, State]:
        """Label → state."""
        raise NotImplementedError

    def set_initial_state(self, initial_states: "Any", userdata: "Any") -> None:
        """Set the labels to start with, and userdata."""
        raise NotImplementedError

    def get_initial_states(self) -> list[str]:
        """Labels to start with."""
        raise NotImplementedError

    def get_active_states(self) -> list[str]:
        """Labels that run."""
        raise NotImplementedError

    def get_internal_edges(self) -> list[tuple[str, str, str | None]]:
        """List of (outcome, from label, to label)."""
        raise NotImplementedError

    def check_consistency(self) -> None:
        """Check that all references exist.

        Raises:
            InvalidStateError: a state does not exist.
            InvalidTransitionError: a transition's target does not exist.
        """
        raise NotImplementedError

    def register_start_cb(self, start_cb: "Callable[..., object]", cb_args: "Iterable[Any]" = ()) -> None:
        """Call a function with (userdata, initial labels, *cb_args) at each start."""
        self._start_cbs.append((start_cb, cb_args))

    def register_transition_cb(self, transition_cb: "Callable[..., object]", cb_args: "Iterable[Any]" = ()) -> None:
        """Call a function with (userdata, active labels, *cb_args) at each transition."""
        self._transition_cbs.append((transition_cb, cb_args))

    def register_termination_cb(self, termination_cb: "Callable[..., object]", cb_args: "Iterable[Any]" = ()) -> None:
        """Call a function with (userdata, final labels, outcome, *cb_args) at each end."""
        self._termination_cbs.append((termination_cb, cb_args))

    def call_start_cbs(self) -> None:
        """Call the functions registered for the start."""
        _call("start", self._start_cbs, lambda: (self.userdata, self.get_initial_states()))

    def call_transition_cbs(self) -> None:
        """Call the functions registered for transitions."""
        _call("transition", self._transition_cbs, lambda: (self.userdata, self.get_active_states()))

    def call_termination_cbs(self, terminal_states: "Any", outcome: str) -> None:
        """Call the functions registered for the end."""
        _call("termination", self._termination_cbs, lambda: (self.userdata, terminal_states, outcome))

    def open(self) -> None:
        """Open the container for adding states."""
        Container._construction_stack.append(self)
        Container._construction_lock.acquire()

    def close(self) -> None:
        """End adding states, and check consistency; faults are logged.

        Raises:
            InvalidStateError: another container was opened later.
        """
        stack = Container._construction_stack
        if stack and stack[-1] is not self:
            raise InvalidStateError("Attempting to close a container that is not currently open.")
        stack.pop()
        Container._construction_lock.release()
        try:
            self.check_consistency()
        except (InvalidStateError, InvalidTransitionError):
            logerr("Container consistency check failed.")

    def __enter__(self) -> "Self":
        self.open()
        return self

    def __exit__(
        self, exc_type: type[BaseException] | None, exc_val: BaseException | None, exc_tb: "TracebackType | None"
    ) -> None:
        if exc_type is None:
            self.close()
            return
        if exc_type not in (InvalidStateError, InvalidTransitionError):
            lines = traceback.format_exception(exc_type, exc_val, exc_tb)
            logerr("Error raised during SMACH container construction: \n" + "\n".join(lines))
        Container._construction_stack.pop()
        Container._construction_lock.release()

    @contextmanager
    def opened(self, **kwargs: "Any") -> "Generator[Self]":
        """Open the container for the duration of a context."""
        self.open()
        previous, Container._context_kwargs = Container._context_kwargs, kwargs
        try:
            yield self
        finally:
            Container._context_kwargs = previous
            self.close()

    def is_opened(self) -> bool:
        """True if the container is open for adding states."""
        stack = Container._construction_stack
        return bool(stack) and stack[-1] is self

    def assert_opened(self, msg: str = "") -> None:
        """Raise InvalidConstructionError unless the container is open."""
        if not self.is_opened():
            raise InvalidConstructionError(msg)

    @classmethod
    def _currently_opened_container(cls) -> "Self":
        if not Container._construction_stack:
            raise InvalidStateError("Attempting to access the currently opened container, but no container is opened.")
        opened = Container._construction_stack[-1]
        if not isinstance(opened, cls):
            raise InvalidStateError(f"Attempting to call a {cls} construction method without having opened a {cls}.")
        return opened

    def _copy_input_keys(self, parent_ud: "Any", ud: "Any") -> None:
        _copy(self.get_registered_input_keys(), parent_ud, ud, "input")

    def _copy_output_keys(self, ud: "Any", parent_ud: "Any") -> None:
        _copy(self.get_registered_output_keys(), ud, parent_ud, "output")


def _copy(keys: "Iterable[str]", source: "Any", target: "Any", kind: str) -> None:
    if source is None or target is None:
        return
    for key in keys:
        try:
            target[key] = source[key]
        except KeyError:
            logwarn(f"Attempting to copy {kind} key '{key}', but this key does not exist.")


def _call(kind: str, callbacks: "list[_Callback]", arguments: "Callable[[], tuple[Any, ...]]") -> None:
    try:
        for callback, extra in callbacks:
            callback(*arguments(), *extra)
    except Exception:
        logerr(f"Could not execute {kind} callback: {traceback.format_exc()}")
