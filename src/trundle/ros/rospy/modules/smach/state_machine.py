"""Container that runs one state at a time."""

import threading
import traceback

from .container import Container
from .exceptions import InvalidStateError, InvalidTransitionError, InvalidUserCodeError
from .log import logerr, loginfo, logwarn
from .state import State
from .user_data import Remapper, UserData
from .util import is_shutdown

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Any


class StateMachine(Container):
    """Runs a state, then the target of its outcome's transition."""

    def __init__(
        self, outcomes: "Iterable[str]", input_keys: "Iterable[str]" = (), output_keys: "Iterable[str]" = ()
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._state_transitioning_lock = threading.Lock()
        self._is_running = False
        self._initial_state_label: str | None = None
        self._current_label: str | None = None
        self._current_state: State | None = None
        self._current_transitions: dict[str, str | None] | None = None
        self._preempted_label: str | None = None
        self._preempted_state: State | None = None
        self._states: dict[str, State] = {}
        self._transitions: dict[str, dict[str, str | None]] = {}
        self._remappings: dict[str, Mapping[str, str]] = {}
        self._constants: dict[str, Mapping[str, Any]] = {}
        self._last_added_label: str | None = None
        self._connector_outcomes: Iterable[str] = []

    def __getstate__(self) -> "dict[str, Any]":
        return {name: value for name, value in self.__dict__.items() if name != "_state_transitioning_lock"}

    def __setstate__(self, d: "dict[str, Any]") -> None:
        self.__dict__ = d
        self._state_transitioning_lock = threading.Lock()

    @staticmethod
    def add(
        label: str,
        state: State,
        transitions: "Mapping[str, str | None] | None" = None,
        remapping: "Mapping[str, str] | None" = None,
        constants: "Mapping[str, Any] | None" = None,
    ) -> State:
        """Add a state to the open machine, and return it; the first one is the initial one.

        Args:
            label: state's name.
            state: state to add.
            transitions: outcome → label, or outcome of the machine; default: the machine's outcome of the same name.
            remapping: the state's key → key of the machine's userdata.
            constants: key → value, set in the userdata before the state runs.

        Raises:
            InvalidTransitionError: the state has no such outcome.
            InvalidStateError: duplicate label, or no machine is open.
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
    def add_auto(
        label: str,
        state: State,
        connector_outcomes: "Iterable[str]",
        transitions: "Mapping[str, str | None] | None" = None,
        remapping: "Mapping[str, str] | None" = None,
        constants: "Mapping[str, Any] | None" = None,
    ) -> State:
        """Add a state whose `connector_outcomes` lead to the state that is added next; see `add`."""
        self = StateMachine._currently_opened_container()
        StateMachine.add(label, state, transitions, remapping, constants)
        outcomes = state.get_registered_outcomes()
        if not all(outcome in outcomes for outcome in connector_outcomes):
            raise InvalidStateError(f"state '{label}' has the outcomes {outcomes}, not all of {connector_outcomes}")
        self._last_added_label = label
        self._connector_outcomes = connector_outcomes
        return state

    def execute(self, parent_ud: "Any" = None) -> str | None:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Run from the initial state to an outcome; None if the machine is inconsistent or the program ends.

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

    def _update_once(self) -> str | None:
        """Run the current state; returns the machine's outcome, or None if the machine continues."""
        label, state, transitions = self._current_label, self._current_state, self._current_transitions
        if label is None or state is None or transitions is None:
            raise InvalidStateError(f"State '{label}' does not exist. Available states are: {list(self._states)}")
        if self.preempt_requested():
            self._forward_preempt()
        outcome = self._run(label, state)
        if outcome not in transitions or outcome not in state.get_registered_outcomes():
            raise InvalidTransitionError(
                f"Attempted to return outcome '{outcome}' from state '{label}' of type '{state}' which only has "
                f"registered outcomes: {state.get_registered_outcomes()}"
            )
        target = transitions[outcome]
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

    def _run(self, label: str, state: State) -> "Any":
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

    def _set_current_state(self, label: str | None) -> None:
        self._current_label = label
        self._current_state = None if label is None else self._states.get(label)
        self._current_transitions = None if label is None else self._transitions.get(label)

    def is_running(self) -> bool:
        """True while the machine is executed."""
        return self._is_running

    def request_preempt(self) -> None:
        """Request preemption of the machine and its current state."""
        with self._state_transitioning_lock:
            self._preempt_requested = True
            if self._current_state is not None:
                self._preempt_current_state()

    def _forward_preempt(self) -> None:
        """Forward a preempt request that arrived between two states."""
        loginfo("Preempt requested on state machine before executing the next state.")
        if self._preempted_state is not None and not self._preempted_state.preempt_requested():
            self._preempt_requested = False  # the previous state serviced it
            self._preempted_state = None
        else:
            self._preempt_current_state()

    def _preempt_current_state(self) -> None:
        if self._preempted_state is self._current_state or self._current_state is None:
            return
        if self._preempted_state is not None:
            self._preempted_state.recall_preempt()
        self._preempted_state, self._preempted_label = self._current_state, self._current_label
        try:
            self._preempted_state.request_preempt()
        except Exception:
            logerr(f"Failed to preempt contained state '{self._preempted_label}': {traceback.format_exc()}")

    def get_children(self) -> dict[str, State]:
        """Label → state."""
        return self._states

    def __getitem__(self, key: str) -> State:
        if key not in self._states:
            logerr(
                f"Attempting to get state '{key}' from StateMachine container. "
                f"The only available states are: {list(self._states)}"
            )
            raise KeyError(key)
        return self._states[key]

    def set_initial_state(self, initial_states: "Any", userdata: "Any" = None) -> None:
        """Set the label to start with (the first of a list), and userdata."""
        if len(initial_states) > 1:
            logwarn("a StateMachine has one initial state; the first of several is used")
        if initial_states:
            self._initial_state_label = initial_states[0]
        self.userdata.update(userdata or UserData())

    def get_active_states(self) -> list[str]:
        """Label of the current state, in a list."""
        return [str(self._current_label)]

    def get_initial_states(self) -> list[str]:
        """Label of the initial state, in a list."""
        return [str(self._initial_state_label)]

    def get_internal_edges(self) -> list[tuple[str, str, str | None]]:
        """List of (outcome, from label, to label)."""
        return [
            (outcome, label, target)
            for label, transitions in self._transitions.items()
            for outcome, target in transitions.items()
        ]

    def check_state_spec(self, label: str, state: State, transitions: "Mapping[str, str | None]") -> None:
        """Raise InvalidTransitionError if a transition names an outcome that the state does not have."""
        outcomes = state.get_registered_outcomes()
        for outcome in transitions:
            if outcome not in outcomes:
                raise InvalidTransitionError(
                    f"Specified outcome '{outcome}' on state '{label}', which only has available registered outcomes: "
                    f"{outcomes}"
                )

    def check_consistency(self) -> None:
        """Raise InvalidTransitionError if a state or an outcome is missing."""
        outcomes = self.get_registered_outcomes()
        available = {*self._states, *outcomes}
        errors: list[str] = []
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
