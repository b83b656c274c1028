"""Container that runs one state for each of some items."""

import traceback

from .container import Container
from .exceptions import InvalidUserCodeError
from .log import logerr, loginfo, logwarn
from .util import is_shutdown


class Iterator(Container):
    """A for loop; its state finds the item in the userdata."""

    def __init__(self, outcomes, input_keys, output_keys, it=(), it_label="it_data", exhausted_outcome="exhausted"):
        """Declare the loop.

        Args:
            outcomes: of the container.
            input_keys: keys that are read.
            output_keys: keys that are written.
            it: items, or a function that returns them.
            it_label: key of the item.
            exhausted_outcome: outcome after the last item.
        """
        super().__init__({*outcomes, exhausted_outcome}, input_keys, output_keys)
        self._items = it
        self._items_label = it_label
        self._exhausted_outcome = exhausted_outcome
        self._is_running = False
        self._state_label = ""
        self._state = None
        self._loop_outcomes, self._break_outcomes = [], []
        self._final_outcome_map = {}

    @staticmethod
    def set_iteritems(it, it_label="it_data"):
        """Set the items of the open iterator, and their key."""
        self = Iterator._currently_opened_container()
        self._items, self._items_label = it, it_label

    @staticmethod
    def set_contained_state(label, state, loop_outcomes=(), break_outcomes=(), final_outcome_map=None):
        """Set the state of the open iterator.

        Args:
            label: its name.
            state: the state.
            loop_outcomes: outcomes to go on after; default: those that are no break_outcomes.
            break_outcomes: outcomes to end after; default: those that are no loop_outcomes.
            final_outcome_map: the state's outcome → the container's.
        """
        self = Iterator._currently_opened_container()
        self._state_label, self._state = label, state
        if loop_outcomes and break_outcomes:
            logwarn("an Iterator has both loop_outcomes and break_outcomes; the loop_outcomes are ignored")
        others = [each for each in state.get_registered_outcomes() if each not in (break_outcomes or loop_outcomes)]
        if break_outcomes:
            self._break_outcomes, self._loop_outcomes = list(break_outcomes), others
        else:
            self._loop_outcomes, self._break_outcomes = list(loop_outcomes), others
        self._final_outcome_map = final_outcome_map or {}

    def execute(self, parent_ud=None):
        """Run the state for each item; returns an outcome.

        Raises:
            InvalidUserCodeError: the state raised an exception.
        """
        self._is_running = True
        self._copy_input_keys(parent_ud, self.userdata)
        self.call_start_cbs()
        outcome = self._exhausted_outcome
        for item in self._items() if callable(self._items) else self._items:
            if is_shutdown():
                break
            loginfo(f"Iterating {item} of {self._items}")
            self.userdata[self._items_label] = item
            last = self._run()
            if self._preempt_requested or last not in self._loop_outcomes:
                self._preempt_requested = False
                outcome = last
                break
            self.call_transition_cbs()
        outcome = self._final_outcome_map.get(outcome, outcome)
        self._copy_output_keys(self.userdata, parent_ud)
        self._is_running = False
        self.call_termination_cbs(self._state_label, outcome)
        return outcome

    def _run(self):
        try:
            return self._state.execute(self.userdata)
        except InvalidUserCodeError:
            logerr(f"Could not execute Iterator state '{self._state_label}'")
            raise
        except Exception:
            raise InvalidUserCodeError(
                f"Could not execute iterator state '{self._state_label}' of type '{self._state}': "
                f"{traceback.format_exc()}"
            ) from None

    def request_preempt(self):
        """Ask the loop, and its state, to end soon."""
        self._preempt_requested = True
        if self._is_running:
            self._state.request_preempt()

    def get_children(self):
        """Label → state."""
        return {self._state_label: self._state}

    def __getitem__(self, key):
        if key != self._state_label:
            logerr(f"Iterator container has the state '{self._state_label}', not '{key}'")
            raise KeyError(key)
        return self._state

    def get_initial_states(self):
        """The state's label, in a list."""
        return [self._state_label]

    def set_initial_state(self, initial_states, userdata):
        """Set userdata; KeyError if the label is not the state's."""
        if initial_states and initial_states[0] != self._state_label:
            logwarn(f"Iterator container has the state '{self._state_label}', not '{initial_states[0]}'")
            raise KeyError(initial_states[0])
        self.userdata.update(userdata)

    def get_active_states(self):
        """The state's label in a list, while it runs."""
        return [self._state_label] if self._is_running else []

    def get_internal_edges(self):
        """List of (outcome, from label, to label or outcome)."""
        edges = [[outcome, self._state_label, self._state_label] for outcome in self._loop_outcomes]
        for outcome in self._break_outcomes:
            final = self._final_outcome_map.get(outcome, outcome)
            edges.append((outcome, self._state_label, None if final == outcome else final))
        return edges

    def check_consistency(self):
        """Nothing can be inconsistent."""
