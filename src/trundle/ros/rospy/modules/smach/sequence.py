"""State machine whose states follow one another in the order they were added."""

from .exceptions import InvalidStateError, InvalidTransitionError
from .log import logerr
from .state import State
from .state_machine import StateMachine

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


class Sequence(StateMachine):
    """States in a row, connected by one outcome."""

    def __init__(
        self,
        outcomes: "Iterable[str]",
        connector_outcome: str,
        input_keys: "Iterable[str]" = (),
        output_keys: "Iterable[str]" = (),
    ) -> None:
        """Declare the outcomes, and the one that leads from a state to the next."""
        super().__init__(outcomes, input_keys, output_keys)
        self._last_added_seq_label: str | None = None
        self._connector_outcome = connector_outcome

    @staticmethod
    def add(  # pyright: ignore[reportIncompatibleMethodOverride]
        label: str,
        state: State,
        transitions: "Mapping[str, str | None] | None" = None,
        remapping: "Mapping[str, str] | None" = None,
    ) -> State:
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
