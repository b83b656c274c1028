"""Callbacks of states, with what they declare."""

import smach


class StateCallback:
    """A function that is called with a part of the userdata."""

    def __init__(self, state, function, args, kwargs, input_keys, output_keys, *, declares_outcomes):
        """Declare the function's keys in a state.

        Raises:
            smach.InvalidStateError: it is not callable.
        """
        if function is not None and not callable(function):
            raise smach.InvalidStateError(f"the callback {function!r} is not callable")
        self.function = function
        self._args, self._kwargs = args, kwargs or {}
        self._input_keys, self._output_keys = input_keys, output_keys
        if smach.has_smach_interface(function):
            self._input_keys = function.get_registered_input_keys()
            self._output_keys = function.get_registered_output_keys()
            if declares_outcomes:
                state.register_outcomes(function.get_registered_outcomes())
        state.register_input_keys(self._input_keys)
        state.register_output_keys(self._output_keys)

    def __call__(self, userdata, *values):
        remapper = smach.Remapper(userdata, self._input_keys, self._output_keys)
        return self.function(remapper, *values, *self._args, **self._kwargs)
