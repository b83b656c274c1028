"""Callbacks for resets of a simulation's poses, and of single models."""

from collections.abc import Callable


class Resets:
    """Functions called after resets."""

    def __init__(self) -> None:
        self._calls: list[tuple[Callable[[], None], object | None]] = []

    def add(self, call: Callable[[], None], model: object | None) -> None:
        """Call a function after each reset of all poses, and of one model, given by its handle."""
        self._calls.append((call, model))

    def forget(self, model: object) -> None:
        """Remove the functions of a deleted model."""
        self._calls = [(call, owner) for call, owner in self._calls if owner is not model]

    def of_model(self, model: object) -> list[Callable[[], None]]:
        """Return the functions called after each reset of one model, given by its handle."""
        return [call for call, owner in self._calls if owner is model]

    def finish(self, model: object | None = None) -> None:
        """Call the functions of one model, given by its handle; None: all functions."""
        for call in [call for call, _ in self._calls] if model is None else self.of_model(model):
            call()
