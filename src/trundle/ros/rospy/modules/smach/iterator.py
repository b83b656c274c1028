"""Container that runs one state for each item of an iterable."""

import traceback

from .container import Container
from .exceptions import InvalidUserCodeError
from .log import logerr, loginfo, logwarn
from .state import State
from .util import is_shutdown

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Any


class Iterator(Container):
    """A for loop; its state reads the item from the userdata."""

    def __init__(
        self,
        outcomes: "Iterable[str]",
        input_keys: "Iterable[str]",
        output_keys: "Iterable[str]",
        it: "Any" = (),
        it_label: str = "it_data",
        exhausted_outcome: str = "exhausted",
    ) -> None:
        """Declare the loop.

        Args:
            outcomes: container's outcomes.
            input_keys: keys that are read.
            output_keys: keys that are written.
            it: items, or a function that returns them.
            it_label: key of the item.
            exhausted_outcome: outcome after the last item.
        """
        super().__init__({*outcomes, exhausted_outcome}, input_keys, output_keys)
        self._items: Any = it
        self._items_label = it_label
        self._exhausted_outcome = exhausted_outcome
        self._is_running = False
        self._state_label = ""
        self._state: Any = None
        self._loop_outcomes: list[str] = []
        self._break_outcomes: list[str] = []
        self._final_outcome_map: Mapping[str, str] = {}

    @staticmethod
    def set_iteritems(it: "Any", it_label: str = "it_data") -> None:
        """Set the items of the open iterator, and their key."""
        self = Iterator._currently_opened_container()
        self._items, self._items_label = it, it_label

    @staticmethod
    def set_contained_state(
        label: str,
        state: State,
        loop_outcomes: "Iterable[str]" = (),
        break_outcomes: "Iterable[str]" = (),
        final_outcome_map: "Mapping[str, str] | None" = None,
    ) -> None:
        """Set the state of the open iterator.

        Args:
            label: state's name.
            state: contained state.
            loop_outcomes: outcomes that continue the loop; default: all but the break_outcomes.
            break_outcomes: outcomes that end the loop; default: all but the loop_outcomes.
            final_outcome_map: the state's outcome → the container's.
        """
        self = Iterator._currently_opened_container()
        self._state_label, self._state = label, state
        if loop_outcomes and break_outcomes:
            logwarn("an Iterator has both loop_outcomes and break_outcomes; the loop_outcomes are ignored")
        listed = set(break_outcomes or loop_outcomes)
        others = [outcome for outcome in state.get_registered_outcomes() if outcome not in listed]
        if break_outcomes:
            self._break_outcomes, self._loop_outcomes = list(break_outcomes), others
        else:
            self._loop_outcomes, self._break_outcomes = list(loop_outcomes), others
        self._final_outcome_map = final_outcome_map or {}

    def execute(self, parent_ud: "Any" = None) -> str:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Run the state for each item; returns an outcome.

        Raises:
            InvalidUserCodeError: the state raised an exception.
        """
        self._is_running = True
        self._copy_input_keys(parent_ud, self.userdata)
        self.call_start_cbs()
        outcome = self._exhausted_outcome
        items: Any = self._items() if callable(self._items) else self._items
        for item in items:
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

    def _run(self) -> str:
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

    def request_preempt(self) -> None:
        """Request preemption of the loop and its state."""
        self._preempt_requested = True
        if self._is_running:
            self._state.request_preempt()

    def get_children(self) -> dict[str, State]:
        """Label → state."""
        return {self._state_label: self._state}

    def __getitem__(self, key: str) -> State:
        if key != self._state_label:
            logerr(f"Iterator container has the state '{self._state_label}', not '{key}'")
            raise KeyError(key)
        return self._state

    def get_initial_states(self) -> list[str]:
        """The state's label, in a list."""
        return [self._state_label]

    def set_initial_state(self, initial_states: "Any", userdata: "Any") -> None:
        """Set userdata; KeyError if the label is not the state's."""
        if initial_states and initial_states[0] != self._state_label:
            logwarn(f"Iterator container has the state '{self._state_label}', not '{initial_states[0]}'")
            raise KeyError(initial_states[0])
        self.userdata.update(userdata)

    def get_active_states(self) -> list[str]:
        """The state's label in a list while the loop runs, else an empty list."""
        return [self._state_label] if self._is_running else []

    def get_internal_edges(self) -> list[tuple[str, str, str | None]]:
        """List of (outcome, from label, to label or outcome)."""
        edges: list[Any] = [[outcome, self._state_label, self._state_label] for outcome in self._loop_outcomes]
        for outcome in self._break_outcomes:
            final = self._final_outcome_map.get(outcome, outcome)
            edges.append((outcome, self._state_label, None if final == outcome else final))
        return edges

    def check_consistency(self) -> None:
        """Nothing can be inconsistent."""
