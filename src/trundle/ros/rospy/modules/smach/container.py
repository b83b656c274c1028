"""Base of states that hold states."""

import threading
import traceback
from contextlib import contextmanager

from .exceptions import InvalidConstructionError, InvalidStateError, InvalidTransitionError
from .log import logerr, logwarn
from .state import State
from .user_data import UserData


class Container(State):
    """A state of states. States are added while it is open: `with container: …`."""

    _construction_stack = []
    _construction_lock = threading.RLock()
    _context_kwargs = {}

    def __init__(self, outcomes=(), input_keys=(), output_keys=()):
        super().__init__(outcomes, input_keys, output_keys)
        self.userdata = UserData()
        self._start_cbs = []
        self._transition_cbs = []
        self._termination_cbs = []

    def __getitem__(self, key):
        raise NotImplementedError

    def get_children(self):
        """Label → state."""
        raise NotImplementedError

    def set_initial_state(self, initial_states, userdata):
        """Set the labels to start with, and userdata."""
        raise NotImplementedError

    def get_initial_states(self):
        """Labels to start with."""
        raise NotImplementedError

    def get_active_states(self):
        """Labels that run."""
        raise NotImplementedError

    def get_internal_edges(self):
        """List of (outcome, from label, to label)."""
        raise NotImplementedError

    def check_consistency(self):
        """Check that all references exist.

        Raises:
            InvalidStateError: a state does not.
            InvalidTransitionError: a transition's end does not.
        """
        raise NotImplementedError

    def register_start_cb(self, start_cb, cb_args=()):
        """Call a function with (userdata, initial labels, *cb_args) at each start."""
        self._start_cbs.append((start_cb, cb_args))

    def register_transition_cb(self, transition_cb, cb_args=()):
        """Call a function with (userdata, active labels, *cb_args) at each transition."""
        self._transition_cbs.append((transition_cb, cb_args))

    def register_termination_cb(self, termination_cb, cb_args=()):
        """Call a function with (userdata, final labels, outcome, *cb_args) at each end."""
        self._termination_cbs.append((termination_cb, cb_args))

    def call_start_cbs(self):
        """Call the functions registered for the start."""
        _call("start", self._start_cbs, lambda: (self.userdata, self.get_initial_states()))

    def call_transition_cbs(self):
        """Call the functions registered for transitions."""
        _call("transition", self._transition_cbs, lambda: (self.userdata, self.get_active_states()))

    def call_termination_cbs(self, terminal_states, outcome):
        """Call the functions registered for the end."""
        _call("termination", self._termination_cbs, lambda: (self.userdata, terminal_states, outcome))

    def open(self):
        """Make it the container that states are added to."""
        Container._construction_stack.append(self)
        Container._construction_lock.acquire()

    def close(self):
        """End adding, and check consistency; what is wrong is logged.

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

    def __enter__(self):
        self.open()
        return self

    def __exit__(self, exc_type, exc_val, exc_tb):
        if exc_type is None:
            self.close()
            return
        if exc_type not in (InvalidStateError, InvalidTransitionError):
            lines = traceback.format_exception(exc_type, exc_val, exc_tb)
            logerr("Error raised during SMACH container construction: \n" + "\n".join(lines))
        Container._construction_stack.pop()
        Container._construction_lock.release()

    @contextmanager
    def opened(self, **kwargs):
        """Context in which it is open."""
        self.open()
        before, Container._context_kwargs = Container._context_kwargs, kwargs
        try:
            yield self
        finally:
            Container._context_kwargs = before
            self.close()

    def is_opened(self):
        """True if states are added to it now."""
        stack = Container._construction_stack
        return bool(stack) and stack[-1] is self

    def assert_opened(self, msg=""):
        """Raise InvalidConstructionError unless it is open."""
        if not self.is_opened():
            raise InvalidConstructionError(msg)

    @classmethod
    def _currently_opened_container(cls):
        if not Container._construction_stack:
            raise InvalidStateError("Attempting to access the currently opened container, but no container is opened.")
        opened = Container._construction_stack[-1]
        if not isinstance(opened, cls):
            raise InvalidStateError(f"Attempting to call a {cls} construction method without having opened a {cls}.")
        return opened

    def _copy_input_keys(self, parent_ud, ud):
        _copy(self.get_registered_input_keys(), parent_ud, ud, "input")

    def _copy_output_keys(self, ud, parent_ud):
        _copy(self.get_registered_output_keys(), ud, parent_ud, "output")


def _copy(keys, source, target, kind):
    if source is None or target is None:
        return
    for key in keys:
        try:
            target[key] = source[key]
        except KeyError:
            logwarn(f"Attempting to copy {kind} key '{key}', but this key does not exist.")


def _call(kind, callbacks, arguments):
    try:
        for callback, extra in callbacks:
            callback(*arguments(), *extra)
    except Exception:
        logerr(f"Could not execute {kind} callback: {traceback.format_exc()}")
