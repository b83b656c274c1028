"""State machine whose states lead to the next one added."""

from .exceptions import InvalidStateError, InvalidTransitionError
from .log import logerr
from .state_machine import StateMachine


class Sequence(StateMachine):
    """States in a row, joined by one outcome."""

    def __init__(self, outcomes, connector_outcome, input_keys=(), output_keys=()):
        """Declare the outcomes, and the one that leads from a state to the next."""
        super().__init__(outcomes, input_keys, output_keys)
        self._last_added_seq_label = None
        self._connector_outcome = connector_outcome

    @staticmethod
    def add(label, state, transitions=None, remapping=None):
        """Add a state after the last one, and return it; see `StateMachine.add`."""
        self = Sequence._currently_opened_container()
        last = self._last_added_seq_label
        if last is not None:
            if not self._transitions[last].get(self._connector_outcome):
                self._transitions[last][self._connector_outcome] = label
            try:
                self.check_state_spec(last, self._states[last], self._transitions[last])
            except (InvalidStateError, InvalidTransitionError):
                logerr("Attempting to construct smach state sequence failed.")
        self._last_added_seq_label = label
        return StateMachine.add(label, state, transitions, remapping)
