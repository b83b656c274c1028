"""Base of states."""

from .util import has_smach_interface


class State:
    """Something that runs and ends with one of its outcomes."""

    def __init__(self, outcomes=(), input_keys=(), output_keys=(), io_keys=()):
        """Declare outcomes, and the keys of userdata that are read, written, or both."""
        self._outcomes = set(outcomes)
        self._input_keys = {*input_keys, *io_keys}
        self._output_keys = {*output_keys, *io_keys}
        self._preempt_requested = False

    def execute(self, ud):
        """Run, with userdata; returns an outcome."""
        raise NotImplementedError

    def register_outcomes(self, new_outcomes):
        """Declare more outcomes."""
        self._outcomes = self._outcomes.union(new_outcomes)

    def get_registered_outcomes(self):
        """Outcomes declared."""
        return tuple(self._outcomes)

    def register_io_keys(self, keys):
        """Declare more keys that are read and written."""
        self.register_input_keys(keys)
        self.register_output_keys(keys)

    def register_input_keys(self, keys):
        """Declare more keys that are read."""
        self._input_keys = self._input_keys.union(keys)

    def get_registered_input_keys(self):
        """Keys that are read."""
        return tuple(self._input_keys)

    def register_output_keys(self, keys):
        """Declare more keys that are written."""
        self._output_keys = self._output_keys.union(keys)

    def get_registered_output_keys(self):
        """Keys that are written."""
        return tuple(self._output_keys)

    def request_preempt(self):
        """Ask the state to end soon."""
        self._preempt_requested = True

    def service_preempt(self):
        """State that the request is answered."""
        self._preempt_requested = False

    def recall_preempt(self):
        """Take the request back."""
        self._preempt_requested = False

    def preempt_requested(self):
        """True if the state should end soon."""
        return self._preempt_requested


class CBState(State):
    """State of a function that takes userdata and returns an outcome."""

    def __init__(self, cb, cb_args=(), cb_kwargs=None, outcomes=(), input_keys=(), output_keys=(), io_keys=()):
        """Wrap a function; what a `cb_interface` declares is declared too."""
        super().__init__(outcomes, input_keys, output_keys, io_keys)
        self._cb = cb
        self._cb_args = cb_args
        self._cb_kwargs = cb_kwargs or {}
        if has_smach_interface(cb):
            self.register_input_keys(cb.get_registered_input_keys())
            self.register_output_keys(cb.get_registered_output_keys())
            self.register_outcomes(cb.get_registered_outcomes())

    def execute(self, ud):
        """Call the function."""
        return self._cb(ud, *self._cb_args, **self._cb_kwargs)
