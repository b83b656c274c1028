"""Copying, deleting and resetting whole models, with their sensors and plugins; all can be undone."""

from collections import deque
from typing import TypeVar

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.page import (
    CopyModel,
    DeleteLight,
    DeleteModel,
    ModelAction,
    ResetModel,
    RestoreLight,
    RestoreModel,
    UndoReset,
)
from trundle.robots.model import Light
from trundle.robots.robot import Robot
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.sim.timeline import SavedObjects, save_plugins

from ..shown_world import ShownWorld
from .edits import find_model
from .saved_model import SavedModel, saved_model

_Value = TypeVar("_Value")
_MAX_UNDO = 200
"""Limit of deleted models, of deleted lights, and of states before resets: the length of the page's undo history."""
_MAX_BYTES = 64 * 1024 * 1024
"""Limit of memory for plugins' states before resets."""


class ModelEdits:
    """Copies, deletes and resets models and lights of one world."""

    def __init__(self, world: ShownWorld) -> None:
        self._world, self._simulation = world, world.simulation
        self._models: dict[str, tuple[SavedModel, Robot | None]] = {}
        self._lights: dict[str, Light] = {}
        self._before_resets: deque[tuple[SavedModel, SavedObjects]] = deque(maxlen=_MAX_UNDO)
        """States of models and of their plugins."""

    def handle(self, action: ModelAction) -> None:
        """Execute a request.

        Raises:
            TrundleError: the request cannot be executed.
        """
        match action:
            case CopyModel(name, new, offset):
                model = find_model(self._simulation, name)
                self._spawn(saved_model(self._simulation, model).copy(new, offset), self._world.robot(model.name))
            case DeleteModel(name):
                self._delete(find_model(self._simulation, name).name)
            case RestoreModel(name):
                if name not in self._models:
                    raise UsageError(f"the page has deleted no model {name!r}")
                self._spawn(*self._models[name])
            case ResetModel(name):
                self._reset(find_model(self._simulation, name))
            case UndoReset(name):
                self._undo_reset(find_model(self._simulation, name))
            case DeleteLight(name):
                self._delete_light(name)
            case RestoreLight(name):
                self._restore_light(name)

    def _spawn(self, saved: SavedModel, robot: Robot | None) -> None:
        self._world.spawn(saved.model, robot)
        self._world.do(saved.apply)

    def _delete(self, name: str) -> None:
        saved = saved_model(self._simulation, self._simulation[name]), self._world.robot(name)
        self._world.delete(name)
        _remember(self._models, name, saved)

    def _reset(self, model: ModelHandle) -> None:
        plugins = save_plugins(self._simulation.resets.of_model(model))
        states = self._before_resets
        states.append((saved_model(self._simulation, model), plugins))
        while len(states) > 1 and sum(objects.size for _, objects in states) > _MAX_BYTES:
            states.popleft()
        self._world.do(lambda sim: sim[model.name].reset())

    def _undo_reset(self, model: ModelHandle) -> None:
        before = next((state for state in reversed(self._before_resets) if state[0].model.name == model.name), None)
        if before is None:
            raise UsageError(f"the page has not reset model {model.name!r}, or too long ago")
        saved, plugins = before
        if not saved.fits(model):
            raise UsageError(f"model {model.name!r} has other links or joints now than when it was reset")
        self._before_resets.remove(before)

        def undo(simulation: Simulation) -> None:
            saved.apply(simulation)
            plugins.restore()

        self._world.do(undo)

    def _delete_light(self, name: str) -> None:
        lights = {light.name: light for light in self._simulation.world.lights}
        if name not in lights:
            raise UsageError(f"the world has no light {name!r}; it has: {', '.join(map(repr, lights)) or 'none'}")

        def delete(sim: Simulation) -> None:
            sim.edit(replace(sim.world, lights=tuple(light for light in sim.world.lights if light.name != name)))

        self._world.do(delete)
        _remember(self._lights, name, lights[name])

    def _restore_light(self, name: str) -> None:
        if name not in self._lights:
            raise UsageError(f"the page has deleted no light {name!r}")
        add_light(self._lights[name], self._world)


def add_light(light: Light, world: ShownWorld) -> None:
    """Add a light to the world.

    Raises:
        UsageError: there is a light of that name already.
    """
    if any(other.name == light.name for other in world.simulation.world.lights):
        raise UsageError(f"there is a light {light.name!r} already")
    world.do(lambda sim: sim.edit(replace(sim.world, lights=(*sim.world.lights, light))))


def _remember(values: dict[str, _Value], name: str, value: _Value) -> None:
    """Store a value as the newest, and drop the oldest beyond the limit."""
    values.pop(name, None)
    values[name] = value
    if len(values) > _MAX_UNDO:
        del values[next(iter(values))]
