"""Callbacks of resets of a simulation's poses, and of single models."""

from collections.abc import Callable


class Resets:
    """Functions that are called after resets."""

    def __init__(self) -> None:
        self._calls: list[tuple[Callable[[], None], object | None]] = []

    def add(self, call: Callable[[], None], model: object | None) -> None:
        """Call a function after each reset of all poses, and of this model alone, which is given by its handle."""
        self._calls.append((call, model))

    def forget(self, model: object) -> None:
        """Remove the functions of a deleted model."""
        self._calls = [each for each in self._calls if each[1] is not model]

    def of_model(self, model: object) -> list[Callable[[], None]]:
        """Return what is called after each reset of one model, by its handle."""
        return [call for call, of in self._calls if of is model]

    def finish(self, model: object | None = None) -> None:
        """Call what waits for resets of one model, by its handle; None: for those of all poses."""
        for call in [call for call, _ in self._calls] if model is None else self.of_model(model):
            call()
