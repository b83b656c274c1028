"""Steps with hooks in C++: actions before each step, recording of contacts after it."""

from collections.abc import Callable, Sequence
from typing import TypeAlias

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from .contact import Contacts
from .contact_query import ContactQuery
from .contact_recorder import ContactRecorder

StepAction: TypeAlias = _contact_laws.StepAction


class StepHooks(Struct, frozen=True, eq=False):
    """Recorders and actions of the coming steps."""

    time_ns: int
    """Time before the first of these steps [ns]."""
    step_ns: int
    """[ns]"""
    recorders: Sequence[ContactRecorder] = ()
    actions: Sequence[StepAction] = ()
    """Actions before each step; before the first step they have acted already."""

    @property
    def is_empty(self) -> bool:
        """True without recorders and actions."""
        return not self.recorders and not self.actions


class Stepper:
    """Steps in C++ from one time on."""

    def __init__(
        self,
        hooks: StepHooks,
        compiled: CompiledWorld,
        data: mujoco.MjData,
        *,
        query: ContactQuery,
        state: Callable[[], NDArray[np.float64]],
    ) -> None:
        """Save the actions' state.

        Args:
            hooks: recorders and actions.
            compiled: the world.
            data: its state.
            query: evaluates contacts of sleeping bodies.
            state: returns the state (mjSTATE_INTEGRATION).
        """
        self._hooks = hooks
        self._natives = [recorder.bind(compiled) for recorder in hooks.recorders]
        self._restores = [action.checkpoint() for action in hooks.actions]
        self._time_ns = hooks.time_ns
        self._addresses = compiled.model._address, data._address
        self._query = query
        self._state = state

    def step(self, count: int) -> int:
        """Step `count` times, or fewer if an action needs Python; return the number of steps."""
        hooks, remaining, goes_on = self._hooks, count, True
        while remaining > 0 and goes_on:
            acts_first = self._time_ns > hooks.time_ns
            stepped, goes_on = _contact_laws.step(
                *self._addresses, remaining, self._natives, hooks.actions, acts_first, self._time_ns, hooks.step_ns
            )
            self._time_ns += stepped * hooks.step_ns
            remaining -= stepped
            for recorder, native in zip(hooks.recorders, self._natives, strict=True):
                if native.is_stale:
                    native.set_sleeping(self._query.sleeping_contacts(recorder.collisions, self._state).rows)
        return count - remaining

    def replace_last(self, contacts: Callable[[frozenset[str]], Contacts]) -> None:
        """Record the contacts of the current state in place of the last step's."""
        for recorder, native in zip(self._hooks.recorders, self._natives, strict=True):
            native.replace_since(self._time_ns, contacts(recorder.collisions).rows)

    def roll_back(self) -> None:
        """Restore the recorders and actions to the state before all steps."""
        nothing = np.empty((0, 15))
        for native in self._natives:
            native.replace_since(self._hooks.time_ns + self._hooks.step_ns, nothing)
        for restore in self._restores:
            restore()
        self._time_ns = self._hooks.time_ns
