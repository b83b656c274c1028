"""Container whose states run at the same time."""

import copy
import threading
import traceback

from .container import Container
from .exceptions import InvalidStateError, InvalidTransitionError, InvalidUserCodeError
from .log import logerr, loginfo, logwarn
from .user_data import Remapper
from .util import is_shutdown

_POLL_S = 0.1


class Concurrence(Container):
    """Runs each state on a thread of its own."""

    def __init__(
        self,
        outcomes,
        default_outcome,
        input_keys=(),
        output_keys=(),
        outcome_map=None,
        outcome_cb=None,
        child_termination_cb=None,
    ):
        """Declare how the outcome comes about.

        Args:
            outcomes: of the container.
            default_outcome: if nothing else holds.
            input_keys: keys that are read.
            output_keys: keys that are written.
            outcome_map: outcome → {label: outcome} that all must hold; the one with the most conditions wins.
            outcome_cb: called with {label: outcome}; returns the outcome, or None.
            child_termination_cb: called with {label: outcome or None} as states end; True ends the others.

        Raises:
            InvalidStateError: one of these is not declared, or not callable.
        """
        super().__init__(outcomes, input_keys, output_keys)
        self._states, self._threads, self._remappings = {}, {}, {}
        self._default_outcome = default_outcome
        self._outcome_map = outcome_map or {}
        self._outcome_cb = outcome_cb
        self._child_termination_cb = child_termination_cb
        self._child_outcomes = {}
        self._user_code_exception = False
        self._done_cond = threading.Condition()
        self._is_over = False
        errors = [
            *(
                f"the outcome '{each}' is not declared"
                for each in (default_outcome, *self._outcome_map)
                if each not in outcomes
            ),
            *(f"{each} is not callable" for each in (outcome_cb, child_termination_cb) if each and not callable(each)),
        ]
        if errors:
            raise InvalidStateError("Errors specifying outcome policy of concurrence: " + "; ".join(errors))

    @staticmethod
    def add(label, state, remapping=None):
        """Add a state to the open concurrence, and return it; remapping as in `StateMachine.add`."""
        self = Concurrence._currently_opened_container()
        self._states[label] = state
        self._remappings[label] = remapping or {}
        return state

    def execute(self, parent_ud=None):
        """Run all states; returns an outcome.

        Raises:
            InvalidStateError: there is no state, or one raised an exception.
            InvalidUserCodeError: a callback raised one.
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

    def _wait_for_end(self):
        """Wait until one end ends all; then preempt those that still run, and wait for them."""
        with self._done_cond:
            while not self._is_over and not self.preempt_requested() and not is_shutdown():
                self._done_cond.wait(_POLL_S)
        for label, outcome in list(self._child_outcomes.items()):
            if outcome is None:
                self._states[label].request_preempt()
        for thread in self._threads.values():
            while thread.is_alive() and not is_shutdown():
                thread.join(_POLL_S)

    def _is_preempted(self):
        """True if a preempt was requested and every state answered it."""
        if not self.preempt_requested():
            return False
        deaf = [label for label, state in self._states.items() if state.preempt_requested()]
        for label in deaf:
            logwarn(f"State '{label}' in concurrence did not service preempt.")
            self._states[label].recall_preempt()
        if not deaf:
            loginfo("Concurrence serviced preempt.")
            self.service_preempt()
        return not deaf

    def _find_outcome(self):
        held = [
            (len(wanted), outcome)
            for outcome, wanted in self._outcome_map.items()
            if all(self._child_outcomes[label] == each for label, each in wanted.items())
        ]
        outcome = max(held, key=lambda pair: pair[0])[1] if held else self._default_outcome
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
            logerr(f"the outcome callback returned {chosen!r}, which is no text; the outcome is '{outcome}'")
        else:
            logwarn(f"Outcome callback returned None, using outcome '{outcome}'")
        return outcome

    def _state_runner(self, label):
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

    def _end(self):
        with self._done_cond:
            self._is_over = True
            self._done_cond.notify_all()

    def request_preempt(self):
        """Ask the container, and all its states, to end soon."""
        super().request_preempt()
        with self._done_cond:
            self._done_cond.notify_all()

    def get_children(self):
        """Label → state."""
        return self._states

    def __getitem__(self, key):
        return self._states[key]

    def get_initial_states(self):
        """All labels."""
        return list(self._states)

    def set_initial_state(self, initial_states, userdata):
        """Set userdata; all states are initial ones."""
        if initial_states and len(initial_states) < len(self._states):
            logwarn("every state of a Concurrence is an initial state; the choice is ignored")
        self.userdata.update(userdata)

    def get_active_states(self):
        """Labels that run."""
        return [label for label, outcome in self._child_outcomes.items() if outcome is None]

    def get_internal_edges(self):
        """List of (outcome, label, outcome of the container)."""
        return [
            (outcome, label, container_outcome)
            for container_outcome, wanted in self._outcome_map.items()
            for label, outcome in wanted.items()
        ]

    def check_consistency(self):
        """Raise InvalidTransitionError if the outcome map names an outcome that a state has not."""
        for wanted in self._outcome_map.values():
            for label, outcome in wanted.items():
                outcomes = self._states[label].get_registered_outcomes()
                if outcome not in outcomes:
                    raise InvalidTransitionError(
                        f"Outcome map in SMACH Concurrence references a state outcome that does not exist. Requested "
                        f"state outcome: '{outcome}', but state '{label}' only has outcomes {outcomes}"
                    )
