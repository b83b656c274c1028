"""Bodies of a scene by name, and which pairs of them are not checked."""

import itertools

import numpy as np

from trundle.planning import _planning
from trundle.spatial import Pose

from .pieces import Pieces, pose_row

_NO_FRAME = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]])


class SceneBodies:
    """Links, objects and voxels as numbered bodies of the C++ side.

    Links come first, by their number in the model.
    """

    def __init__(self, links: tuple[str, ...], world: _planning.CollisionWorld) -> None:
        """Number the links."""
        self.world = world
        self._links = links
        self._names = dict(enumerate(links))
        self._numbers = {link: number for number, link in enumerate(links)}
        self._free_numbers = itertools.count(len(links))
        self._allowed: set[tuple[int, int]] = set()
        """Pairs of bodies that the C++ does not check, the smaller number first."""

    def __contains__(self, name: str) -> bool:
        """True if there is a body of a name."""
        return name in self._numbers

    @property
    def others(self) -> list[str]:
        """Names of the bodies that are no links."""
        return [name for name, number in self._numbers.items() if number >= len(self._links)]

    def name(self, number: int) -> str:
        """Return the name of a body."""
        return self._names[number]

    def is_link(self, number: int) -> bool:
        """True if a body is a link."""
        return number < len(self._links)

    def number(self, name: str) -> int:
        """Return the number of a body, a new one if there is none of the name."""
        if name not in self._numbers:
            number = next(self._free_numbers)
            self._numbers[name], self._names[number] = number, name
        return self._numbers[name]

    def set_link(self, name: str, padding: float, pieces: Pieces) -> None:
        """Set the shapes of a link."""
        number = self._numbers[name]
        self.world.set_body(number, number, padding, pieces.shapes, pieces.poses, _NO_FRAME)

    def set_body(self, name: str, link: int, padding: float, pieces: Pieces, pose: Pose) -> None:
        """Set the shapes of an object at a pose in a link's frame; −1: the model frame."""
        frame = np.array([pose_row(pose)])
        self.world.set_body(self.number(name), link, padding, pieces.shapes, pieces.poses, frame)

    def remove(self, name: str) -> None:
        """Remove an object."""
        number = self._numbers.pop(name)
        del self._names[number]
        self.world.remove_body(number)
        self._allowed = {pair for pair in self._allowed if number not in pair}

    def allow(self, a: str, b: str, *, is_allowed: bool) -> None:
        """Set whether two bodies may touch."""
        first, second = sorted((self._numbers[a], self._numbers[b]))
        pair = (first, second)
        if is_allowed != (pair in self._allowed):
            self.world.allow(*pair, is_allowed)
            (self._allowed.add if is_allowed else self._allowed.discard)(pair)

    def copy(self, world: _planning.CollisionWorld) -> "SceneBodies":
        """Return an independent copy; `world`: copy of the C++ side."""
        copied = SceneBodies(self._links, world)
        copied._names, copied._numbers = dict(self._names), dict(self._numbers)
        copied._free_numbers = itertools.count(max(self._names, default=-1) + 1)
        copied._allowed = set(self._allowed)
        return copied
