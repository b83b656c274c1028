"""Callbacks of states, with the keys and outcomes that they declare."""

from collections.abc import Collection, Iterable, Mapping
from typing import Any

import smach


class StateCallback:
    """A function that is called with a part of the userdata."""

    def __init__(
        self,
        state: smach.State,
        function: Any,
        args: Iterable[Any],
        kwargs: Mapping[str, Any] | None,
        input_keys: Collection[str],
        output_keys: Collection[str],
        *,
        declares_outcomes: bool,
    ) -> None:
        """Declare the function's keys in a state.

        Raises:
            smach.InvalidStateError: the function is not callable.
        """
        if function is not None and not callable(function):
            raise smach.InvalidStateError(f"the callback {function!r} is not callable")
        self.function: Any = function
        self._args, self._kwargs = args, kwargs or {}
        self._input_keys, self._output_keys = input_keys, output_keys
        if smach.has_smach_interface(self.function):
            self._input_keys = self.function.get_registered_input_keys()
            self._output_keys = self.function.get_registered_output_keys()
            if declares_outcomes:
                state.register_outcomes(self.function.get_registered_outcomes())
        state.register_input_keys(self._input_keys)
        state.register_output_keys(self._output_keys)

    def __call__(self, userdata: Any, *values: object) -> Any:
        remapper = smach.Remapper(userdata, self._input_keys, self._output_keys)
        return self.function(remapper, *values, *self._args, **self._kwargs)
