"""Container whose states run one after the other."""

import threading
import traceback

from .container import Container
from .exceptions import InvalidStateError, InvalidTransitionError, InvalidUserCodeError
from .log import logerr, loginfo, logwarn
from .user_data import Remapper, UserData
from .util import is_shutdown


class StateMachine(Container):
    """Runs a state, and then the one that its outcome leads to."""

    def __init__(self, outcomes, input_keys=(), output_keys=()):
        super().__init__(outcomes, input_keys, output_keys)
        self._state_transitioning_lock = threading.Lock()
        self._is_running = False
        self._initial_state_label = None
        self._current_label = self._current_state = self._current_transitions = None
        self._preempted_label = self._preempted_state = None
        self._states, self._transitions, self._remappings, self._constants = {}, {}, {}, {}
        self._last_added_label = None
        self._connector_outcomes = []

    def __getstate__(self):
        return {name: value for name, value in self.__dict__.items() if name != "_state_transitioning_lock"}

    def __setstate__(self, d):
        self.__dict__ = d
        self._state_transitioning_lock = threading.Lock()

    @staticmethod
    def add(label, state, transitions=None, remapping=None, constants=None):
        """Add a state to the open machine, and return it; the first one is the initial one.

        Args:
            label: its name.
            state: the state.
            transitions: outcome → label, or outcome of the machine; missing ones lead to the machine's of that name.
            remapping: the state's key → key of the machine's userdata.
            constants: key → value, set in the userdata before the state runs.

        Raises:
            InvalidTransitionError: the state has no such outcome.
            InvalidStateError: the label is taken, or no machine is open.
        """
        self = StateMachine._currently_opened_container()
        transitions = dict(transitions or {})
        self.check_state_spec(label, state, transitions)
        if label in self._states:
            raise InvalidStateError(f"the label '{label}' is already used in the state machine")
        if self._initial_state_label is None:
            self._initial_state_label = label
        for outcome in state.get_registered_outcomes():
            transitions.setdefault(outcome, None)
        self._states[label] = state
        self._transitions[label] = transitions
        self._remappings[label] = remapping or {}
        self._constants[label] = constants or {}
        if self._connector_outcomes and self._last_added_label is not None:
            for outcome in self._connector_outcomes:
                self._transitions[self._last_added_label][outcome] = label
            self._connector_outcomes, self._last_added_label = [], None
        return state

    @staticmethod
    def add_auto(label, state, connector_outcomes, transitions=None, remapping=None, constants=None):
        """Add a state whose `connector_outcomes` lead to the state that is added next; see `add`."""
        self = StateMachine._currently_opened_container()
        StateMachine.add(label, state, transitions, remapping, constants)
        outcomes = state.get_registered_outcomes()
        if not all(outcome in outcomes for outcome in connector_outcomes):
            raise InvalidStateError(f"state '{label}' has the outcomes {outcomes}, not all of {connector_outcomes}")
        self._last_added_label = label
        self._connector_outcomes = connector_outcomes
        return state

    def execute(self, parent_ud=None):
        """Run from the initial state to an outcome; None if it is inconsistent or the program ends.

        Raises:
            InvalidUserCodeError: a state raised an exception.
            InvalidTransitionError: a state returned an outcome that it did not declare.
        """
        with self._state_transitioning_lock:
            try:
                self.check_consistency()
            except (InvalidStateError, InvalidTransitionError):
                logerr("Container consistency check failed.")
                return None
            self._is_running = True
            self._preempted_label = self._preempted_state = None
            self._set_current_state(self._initial_state_label)
            self._copy_input_keys(parent_ud, self.userdata)
            loginfo(
                f"State machine starting in initial state '{self._current_label}' with userdata: \n"
                f"\t{self.userdata.keys()}"
            )
            self.call_start_cbs()
            outcome = None
            try:
                while outcome is None and self._is_running and not is_shutdown():
                    outcome = self._update_once()
                self._copy_output_keys(self.userdata, parent_ud)
            finally:
                self._is_running = False
        return outcome

    def _update_once(self):
        """Run the current state; returns the machine's outcome, or None if it goes on."""
        label, state = self._current_label, self._current_state
        if label not in self._states:
            raise InvalidStateError(f"State '{label}' does not exist. Available states are: {list(self._states)}")
        if self.preempt_requested():
            self._pass_preempt_on()
        outcome = self._run(label, state)
        if outcome not in self._current_transitions or outcome not in state.get_registered_outcomes():
            raise InvalidTransitionError(
                f"Attempted to return outcome '{outcome}' from state '{label}' of type '{state}' which only has "
                f"registered outcomes: {state.get_registered_outcomes()}"
            )
        target = self._current_transitions[outcome]
        if target in self._states:
            self._set_current_state(target)
            loginfo(f"State machine transitioning '{label}':'{outcome}'-->'{target}'")
            self.call_transition_cbs()
            return None
        if self._preempt_requested and self._preempted_state is not None and not state.preempt_requested():
            self.service_preempt()
        ends = self.get_registered_outcomes()
        target = target if target in ends else outcome
        if target not in ends:
            raise InvalidTransitionError(
                f"Outcome '{outcome}' of state '{label}' with transition target '{target}' is neither a registered "
                "state nor a registered container outcome."
            )
        self._set_current_state(None)
        loginfo(f"State machine terminating '{label}':'{outcome}':'{target}'")
        self.call_termination_cbs([label], target)
        return target

    def _run(self, label, state):
        self._state_transitioning_lock.release()
        try:
            for key, value in self._constants[label].items():
                self.userdata[key] = value
            inputs, outputs = state.get_registered_input_keys(), state.get_registered_output_keys()
            return state.execute(Remapper(self.userdata, inputs, outputs, self._remappings[label]))
        except InvalidUserCodeError:
            logerr(f"State '{label}' failed to execute.")
            raise
        except Exception:
            raise InvalidUserCodeError(
                f"Could not execute state '{label}' of type '{state}': {traceback.format_exc()}"
            ) from None
        finally:
            self._state_transitioning_lock.acquire()

    def _set_current_state(self, label):
        self._current_label = label
        self._current_state = self._states.get(label)
        self._current_transitions = self._transitions.get(label)

    def is_running(self):
        """True while it is executed."""
        return self._is_running

    def request_preempt(self):
        """Ask the machine, and the state that runs, to end soon."""
        with self._state_transitioning_lock:
            self._preempt_requested = True
            if self._current_state is not None:
                self._preempt_current_state()

    def _pass_preempt_on(self):
        """A request that came before the next state runs."""
        loginfo("Preempt requested on state machine before executing the next state.")
        if self._preempted_state is not None and not self._preempted_state.preempt_requested():
            self._preempt_requested = False  # the state before answered it
            self._preempted_state = None
        else:
            self._preempt_current_state()

    def _preempt_current_state(self):
        if self._preempted_state is self._current_state:
            return
        if self._preempted_state is not None:
            self._preempted_state.recall_preempt()
        self._preempted_state, self._preempted_label = self._current_state, self._current_label
        try:
            self._preempted_state.request_preempt()
        except Exception:
            logerr(f"Failed to preempt contained state '{self._preempted_label}': {traceback.format_exc()}")

    def get_children(self):
        """Label → state."""
        return self._states

    def __getitem__(self, key):
        if key not in self._states:
            logerr(
                f"Attempting to get state '{key}' from StateMachine container. "
                f"The only available states are: {list(self._states)}"
            )
            raise KeyError(key)
        return self._states[key]

    def set_initial_state(self, initial_states, userdata=None):
        """Set the label to start with (the first of a list), and userdata."""
        if len(initial_states) > 1:
            logwarn("a StateMachine has one initial state; the first of several is taken")
        if initial_states:
            self._initial_state_label = initial_states[0]
        self.userdata.update(userdata or UserData())

    def get_active_states(self):
        """Label that runs, in a list."""
        return [str(self._current_label)]

    def get_initial_states(self):
        """Label to start with, in a list."""
        return [str(self._initial_state_label)]

    def get_internal_edges(self):
        """List of (outcome, from label, to label)."""
        return [
            (outcome, label, target)
            for label, transitions in self._transitions.items()
            for outcome, target in transitions.items()
        ]

    def check_state_spec(self, label, state, transitions):
        """Raise InvalidTransitionError if a transition is of an outcome that the state has not."""
        outcomes = state.get_registered_outcomes()
        for outcome in transitions:
            if outcome not in outcomes:
                raise InvalidTransitionError(
                    f"Specified outcome '{outcome}' on state '{label}', which only has available registered outcomes: "
                    f"{outcomes}"
                )

    def check_consistency(self):
        """Raise InvalidTransitionError if a state or an outcome is missing."""
        outcomes = self.get_registered_outcomes()
        available = {*self._states, *outcomes}
        errors = []
        if self._initial_state_label is None:
            errors.append("No initial state set.")
        elif self._initial_state_label not in self._states:
            errors.append(f"Initial state label: '{self._initial_state_label}' is not in the state machine.")
        for label, transitions in self._transitions.items():
            unknown = [target for target in transitions.values() if target and target not in available]
            if unknown:
                errors.append(f"State '{label}' references unknown states: {unknown}")
            unregistered = [
                outcome for outcome, target in transitions.items() if not target and outcome not in outcomes
            ]
            if unregistered:
                errors.append(f"State '{label}' references unregistered outcomes: {unregistered}")
        if errors:
            raise InvalidTransitionError(
                "State machine failed consistency check: \n\t"
                + "\n\t".join(errors)
                + f"\n\n\tAvailable states: {list(available)}"
            )
