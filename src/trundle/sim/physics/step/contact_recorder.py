"""Recording of contacts at every step, in C++ while the engine steps."""

from collections.abc import Callable
from fractions import Fraction

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from .contact import Contacts


class ContactRecorder:
    """Contacts of some collisions at every step; see `StepHooks`."""

    def __init__(self, collisions: frozenset[str], *, max_steps: int) -> None:
        """Create an empty record.

        Args:
            collisions: names `model::link::collision`.
            max_steps: number of the latest steps with contacts to keep.
        """
        self.collisions = collisions
        self._max_steps = max_steps
        self._compiled: CompiledWorld | None = None
        self._native: _contact_laws.ContactRecorder | None = None
        self._earlier: list[tuple[list[int], Contacts]] = []
        """Times [ns] and contacts that were recorded before models were last spawned, deleted or edited."""

    def bind(self, compiled: CompiledWorld) -> _contact_laws.ContactRecorder:
        """Return the recorder of the geoms of a compiled world."""
        if self._native is None or self._compiled is not compiled:
            self._earlier = self._all()
            geoms = [i for i, name in enumerate(compiled.geom_collisions) if name in self.collisions]
            count = len(compiled.geom_collisions)
            self._native = _contact_laws.ContactRecorder(geoms, count, self._max_steps)
            self._compiled = compiled
        return self._native

    def pop(self, *, after_ns: int | Fraction, until_ns: int) -> list[tuple[list[int], Contacts]]:
        """Return times [ns] and contacts, a time for each contact, within the given interval; clear the record."""
        records, self._earlier = self._all(), []
        if records[:1] and not after_ns < records[0][0][0] <= records[-1][0][-1] <= until_ns:
            records = [_within(times_ns, contacts, after_ns, until_ns) for times_ns, contacts in records]
        return records

    def _all(self) -> list[tuple[list[int], Contacts]]:
        """Return all records, and clear the native recorder's."""
        if self._native is None or self._compiled is None:
            return self._earlier
        times_ns, rows = self._native.take()
        latest = [(times_ns, Contacts(self._compiled.geom_collisions, rows))] if times_ns else []
        return [*self._earlier, *latest]

    def checkpoint(self) -> Callable[[], None]:
        """Save the records; return a function that restores them exactly."""
        compiled, earlier = self._compiled, self._earlier.copy()
        native = None if self._native is None else self._native.copy()

        def restore() -> None:
            self._compiled, self._earlier = compiled, earlier.copy()
            self._native = None if native is None else native.copy()

        return restore


def _within(
    times_ns: list[int], contacts: Contacts, after_ns: int | Fraction, until_ns: int
) -> tuple[list[int], Contacts]:
    chosen = [i for i, at_ns in enumerate(times_ns) if after_ns < at_ns <= until_ns]
    return [times_ns[i] for i in chosen], contacts.select(chosen)
