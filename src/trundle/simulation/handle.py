"""What links and joints of a running simulation have in common: a number, as long as their model is there."""

import math
from typing import TYPE_CHECKING, ClassVar

from trundle.diagnostics import UsageError

if TYPE_CHECKING:
    from .simulation import Simulation


class Handle:
    """One thing of a model."""

    KIND: ClassVar[str]
    """What it is, in a sentence."""

    def __init__(self, simulation: "Simulation", index: int) -> None:
        self._simulation = simulation
        self._index: int | None = index

    @property
    def name(self) -> str:
        """As in the file."""
        raise NotImplementedError

    @property
    def index(self) -> int:
        """Into a `Snapshot`'s arrays of its kind; it changes as models before this one go.

        Raises:
            UsageError: the model was deleted.
        """
        if self._index is None:
            raise UsageError(f"{self.KIND} {self.name!r} is gone: its model was deleted")
        return self._index

    @property
    def is_valid(self) -> bool:
        """Whether its model is, still."""
        return self._index is not None

    def rebind(self, index: int | None) -> None:
        """Be at another index, or nowhere any more; for the simulation alone."""
        self._index = index


def expect_finite(*numbers: float) -> None:
    """Refuse what would leave nothing of a world.

    Raises:
        UsageError: a number is none, or endless.
    """
    if not all(map(math.isfinite, numbers)):
        raise UsageError(f"finite numbers are needed, got {', '.join(f'{number:g}' for number in numbers)}")
