"""Container whose states run at the same time."""

import copy
import threading
import traceback

from .container import Container
from .exceptions import InvalidStateError, InvalidTransitionError, InvalidUserCodeError
from .log import logerr, loginfo, logwarn
from .state import State
from .user_data import Remapper
from .util import is_shutdown

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping
    from typing import Any

_POLL_S = 0.1


class Concurrence(Container):
    """Runs each state on a thread of its own."""

    def __init__(
        self,
        outcomes: "Collection[str]",
        default_outcome: str,
        input_keys: "Iterable[str]" = (),
        output_keys: "Iterable[str]" = (),
        outcome_map: "Mapping[str, Mapping[str, str]] | None" = None,
        outcome_cb: "Callable[[Any], Any] | None" = None,
        child_termination_cb: "Callable[[Any], Any] | None" = None,
    ) -> None:
        """Declare the outcomes, and the conditions of each.

        Args:
            outcomes: container's outcomes.
            default_outcome: outcome if no condition holds.
            input_keys: keys that are read.
            output_keys: keys that are written.
            outcome_map: outcome → {label: outcome}, conditions that must all hold; of several outcomes, the one with
                most conditions wins.
            outcome_cb: called with {label: outcome}; returns the outcome, or None.
            child_termination_cb: called with {label: outcome or None} when a state ends; True ends the others.

        Raises:
            InvalidStateError: an outcome is not declared, or a callback not callable.
        """
        super().__init__(outcomes, input_keys, output_keys)
        self._states: dict[str, State] = {}
        self._threads: dict[str, threading.Thread] = {}
        self._remappings: dict[str, Mapping[str, str]] = {}
        self._default_outcome = default_outcome
        self._outcome_map = outcome_map or {}
        self._outcome_cb = outcome_cb
        self._child_termination_cb = child_termination_cb
        self._child_outcomes: dict[str, str | None] = {}
        self._user_code_exception = False
        self._done_cond = threading.Condition()
        self._is_over = False
        errors = [
            *(
                f"the outcome '{outcome}' is not declared"
                for outcome in (default_outcome, *self._outcome_map)
                if outcome not in outcomes
            ),
            *(f"{cb} is not callable" for cb in (outcome_cb, child_termination_cb) if cb and not callable(cb)),
        ]
        if errors:
            raise InvalidStateError("Errors specifying outcome policy of concurrence: " + "; ".join(errors))

    @staticmethod
    def add(label: str, state: State, remapping: "Mapping[str, str] | None" = None) -> State:
        """Add a state to the open concurrence, and return it; remapping as in `StateMachine.add`."""
        self = Concurrence._currently_opened_container()
        self._states[label] = state
        self._remappings[label] = remapping or {}
        return state

    def execute(self, parent_ud: "Any" = None) -> str:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Run all states; returns an outcome.

        Raises:
            InvalidStateError: there is no state, or a state raised an exception.
            InvalidUserCodeError: a callback raised an exception.
        """
        if not self._states:
            raise InvalidStateError("No states was added to concurrence")
        self._child_outcomes = dict.fromkeys(self._states)
        self._is_over = False
        self._copy_input_keys(parent_ud, self.userdata)
        loginfo(f"Concurrence starting with userdata: \n\t{self.userdata.keys()}")
        self.call_start_cbs()
        self._threads = {
            label: threading.Thread(name=f"concurrent_split:{label}", target=self._state_runner, args=(label,))
            for label in self._states
        }
        for thread in self._threads.values():
            thread.start()
        self._wait_for_end()
        if self._user_code_exception:
            self._user_code_exception = False
            raise InvalidStateError("A concurrent state raised an exception during execution.")
        loginfo(f"Concurrent Outcomes: {self._child_outcomes}")
        outcome = "preempted" if self._is_preempted() else self._find_outcome()
        self._threads, self._child_outcomes = {}, {}
        self.call_termination_cbs(list(self._states), outcome)
        self._copy_output_keys(self.userdata, parent_ud)
        return outcome

    def _wait_for_end(self) -> None:
        """Wait for the container's end; then preempt the states that still run, and wait for them."""
        with self._done_cond:
            while not self._is_over and not self.preempt_requested() and not is_shutdown():
                self._done_cond.wait(_POLL_S)
        for label, outcome in list(self._child_outcomes.items()):
            if outcome is None:
                self._states[label].request_preempt()
        for thread in self._threads.values():
            while thread.is_alive() and not is_shutdown():
                thread.join(_POLL_S)

    def _is_preempted(self) -> bool:
        """True if a preempt was requested and every state serviced it."""
        if not self.preempt_requested():
            return False
        unserviced = [label for label, state in self._states.items() if state.preempt_requested()]
        for label in unserviced:
            logwarn(f"State '{label}' in concurrence did not service preempt.")
            self._states[label].recall_preempt()
        if not unserviced:
            loginfo("Concurrence serviced preempt.")
            self.service_preempt()
        return not unserviced

    def _find_outcome(self) -> str:
        matches = [
            (len(conditions), outcome)
            for outcome, conditions in self._outcome_map.items()
            if all(self._child_outcomes[label] == required for label, required in conditions.items())
        ]
        outcome = max(matches, key=lambda match: match[0])[1] if matches else self._default_outcome
        if not self._outcome_cb:
            return outcome
        try:
            chosen = self._outcome_cb(copy.copy(self._child_outcomes))
        except Exception:
            raise InvalidUserCodeError(
                f"Could not execute outcome callback '{self._outcome_cb}': {traceback.format_exc()}"
            ) from None
        if isinstance(chosen, str) and chosen:
            return chosen
        if chosen:
            logerr(f"the outcome callback returned {chosen!r}, which is not a string; the outcome is '{outcome}'")
        else:
            logwarn(f"Outcome callback returned None, using outcome '{outcome}'")
        return outcome

    def _state_runner(self, label: str) -> None:
        """Run one state, on its thread."""
        self.call_transition_cbs()
        state = self._states[label]
        try:
            inputs, outputs = state.get_registered_input_keys(), state.get_registered_output_keys()
            outcome = state.execute(Remapper(self.userdata, inputs, outputs, self._remappings[label]))
            if outcome is None:
                raise InvalidStateError(f"Concurrent state '{label}' returned no outcome on termination.")
            self._child_outcomes[label] = outcome
            loginfo(f"Concurrent state '{label}' returned outcome '{outcome}' on termination.")
            with self._done_cond:
                self.call_transition_cbs()
                ends_others = self._child_termination_cb and self._child_termination_cb(self._child_outcomes)
                if ends_others or None not in self._child_outcomes.values():
                    self._end()
        except Exception:
            self._user_code_exception = True
            self._end()
            logerr(f"Could not execute child state '{label}': {traceback.format_exc()}")

    def _end(self) -> None:
        with self._done_cond:
            self._is_over = True
            self._done_cond.notify_all()

    def request_preempt(self) -> None:
        """Request preemption of the container and all its states."""
        super().request_preempt()
        with self._done_cond:
            self._done_cond.notify_all()

    def get_children(self) -> dict[str, State]:
        """Label → state."""
        return self._states

    def __getitem__(self, key: str) -> State:
        return self._states[key]

    def get_initial_states(self) -> list[str]:
        """All labels."""
        return list(self._states)

    def set_initial_state(self, initial_states: "Any", userdata: "Any") -> None:
        """Set userdata; all states are initial ones."""
        if initial_states and len(initial_states) < len(self._states):
            logwarn("every state of a Concurrence is an initial state; the choice is ignored")
        self.userdata.update(userdata)

    def get_active_states(self) -> list[str]:
        """Labels that run."""
        return [label for label, outcome in self._child_outcomes.items() if outcome is None]

    def get_internal_edges(self) -> list[tuple[str, str, str | None]]:
        """List of (outcome, label, outcome of the container)."""
        return [
            (outcome, label, container_outcome)
            for container_outcome, conditions in self._outcome_map.items()
            for label, outcome in conditions.items()
        ]

    def check_consistency(self) -> None:
        """Raise InvalidTransitionError if the outcome map names an outcome that a state does not have."""
        for conditions in self._outcome_map.values():
            for label, outcome in conditions.items():
                outcomes = self._states[label].get_registered_outcomes()
                if outcome not in outcomes:
                    raise InvalidTransitionError(
                        f"Outcome map in SMACH Concurrence references a state outcome that does not exist. Requested "
                        f"state outcome: '{outcome}', but state '{label}' only has outcomes {outcomes}"
                    )
