"""Allowed collisions, as moveit_msgs/AllowedCollisionMatrix."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from trundle.planning.robot_model import RobotModel


class AllowedCollisionMatrix:
    """Which pairs of links and objects may touch.

    An entry of a pair counts first. Without one, defaults do: a pair may touch if one of its names has a default that
    says so, unless the other's says no (MoveIt's getDefaultEntry).
    """

    def __init__(self, pairs: Iterable[frozenset[str]] = ()) -> None:
        """Allow pairs of names."""
        self._entries: dict[frozenset[str], bool] = dict.fromkeys(pairs, True)
        self._defaults: dict[str, bool] = {}

    @classmethod
    def of_model(cls, model: RobotModel) -> "AllowedCollisionMatrix":
        """Return the matrix of an SRDF; its <disable_default_collisions> are for objects, too."""
        matrix = cls(model.disabled_pairs)
        for name in model.unchecked_links:
            matrix.set_default(name, True)
            for other in model.links:
                if other != name and frozenset((name, other)) not in model.disabled_pairs:
                    matrix.set_entry(name, other, False)
        return matrix

    @classmethod
    def of_matrix(
        cls, names: Sequence[str], rows: Sequence[Sequence[bool]], defaults: Mapping[str, bool]
    ) -> "AllowedCollisionMatrix":
        """Read a matrix of messages; every pair of its names has an entry."""
        matrix = cls()
        for i, (name, row) in enumerate(zip(names, rows, strict=True)):
            for other, is_allowed in zip(names[i + 1 :], row[i + 1 :], strict=False):
                matrix._entries[frozenset((name, other))] = bool(is_allowed)
        matrix._defaults.update(defaults)
        return matrix

    @property
    def names(self) -> list[str]:
        """Names of all entries, sorted."""
        return sorted({name for pair in self._entries for name in pair})

    @property
    def defaults(self) -> dict[str, bool]:
        """Copy of the defaults."""
        return dict(self._defaults)

    def entries(self) -> Iterator[tuple[frozenset[str], bool]]:
        """Iterate over the entries of pairs."""
        return iter(self._entries.items())

    def rows(self) -> list[list[bool]]:
        """Return the matrix of `names`; pairs without an entry are False."""
        names = self.names
        return [[self._entries.get(frozenset((a, b)), False) for b in names] for a in names]

    def entry(self, a: str, b: str) -> bool | None:
        """Return the entry of a pair; None: there is none."""
        return self._entries.get(frozenset((a, b)))

    def allows(self, a: str, b: str) -> bool:
        """Return True if two names may touch."""
        entry = self._entries.get(frozenset((a, b)))
        if entry is not None:
            return entry
        flags = [self._defaults[name] for name in (a, b) if name in self._defaults]
        return bool(flags) and all(flags)

    def set_entry(self, a: str, b: str, is_allowed: bool) -> None:
        """Set the entry of a pair."""
        self._entries[frozenset((a, b))] = is_allowed

    def set_entries(self, name: str, others: Iterable[str], is_allowed: bool) -> None:
        """Set the entries of a name with others."""
        for other in others:
            if other != name:
                self._entries[frozenset((name, other))] = is_allowed

    def set_default(self, name: str, is_allowed: bool) -> None:
        """Set what counts for a name's pairs without an entry."""
        self._defaults[name] = is_allowed

    def remove_entry(self, a: str, b: str) -> None:
        """Remove the entry of a pair, if there is one."""
        self._entries.pop(frozenset((a, b)), None)

    def remove(self, name: str) -> None:
        """Remove all entries and the default of a name."""
        self._entries = {pair: flag for pair, flag in self._entries.items() if name not in pair}
        self._defaults.pop(name, None)

    def copy(self) -> "AllowedCollisionMatrix":
        """Return a copy."""
        matrix = AllowedCollisionMatrix()
        matrix._entries = dict(self._entries)
        matrix._defaults = dict(self._defaults)
        return matrix

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, AllowedCollisionMatrix):
            return NotImplemented
        return self._entries == other._entries and self._defaults == other._defaults

    __hash__ = None  # pyright: ignore[reportAssignmentType]
