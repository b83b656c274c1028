"""Base of link and joint handles: an index that is valid while the model exists."""

from typing import TYPE_CHECKING, ClassVar

from trundle.base.diagnostics import UsageError

if TYPE_CHECKING:
    from .runtime import Runtime


class Handle:
    """Handle of a part of a model."""

    KIND: ClassVar[str]
    """Kind of part, for messages."""

    def __init__(self, simulation: "Runtime", index: int) -> None:
        self._simulation = simulation
        self._index: int | None = index

    @property
    def name(self) -> str:
        """Name as in the file."""
        raise NotImplementedError

    @property
    def index(self) -> int:
        """Index into a `Snapshot`'s arrays; it changes when models before this one are deleted.

        Raises:
            UsageError: the model was deleted.
        """
        if self._index is None:
            raise UsageError(f"{self.KIND} {self.name!r} is gone: its model was deleted")
        return self._index

    @property
    def is_valid(self) -> bool:
        """True while the model exists."""
        return self._index is not None

    def rebind(self, index: int | None) -> None:
        """Set the index, or None after deletion; for the simulation only."""
        self._index = index
