"""Setup of a launch's world with the properties, events and measures of a row."""

from collections.abc import Sequence

from msgspec.structs import replace

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.robots.model import Model, World
from trundle.ros import Node
from trundle.sim.simulation import Simulation
from trundle.spatial import NS_PER_S

from .assignments import Property
from .plan import Plan
from .rows import Row
from .script import RunScript
from .state_names import StateExpressions
from .topics import TopicReader

_MODELS = "models"


class LaunchSetup:
    """Properties, events and measures of a row in the world of a launch; see `WorldSetup`."""

    simulation: Simulation
    script: RunScript

    def __init__(
        self,
        plan: Plan,
        row: Row,
        properties: Sequence[Property],
        expressions: StateExpressions,
        topics: list[str],
    ) -> None:
        self._plan = plan
        self._row = row
        self._properties = properties
        self._unassigned = {property_.path: property_ for property_ in properties}
        """Properties not yet assigned to a world or model."""
        self._expressions = expressions
        self._topics = topics
        self._base: World | None = None
        self._error: TrundleError | None = None
        self._has_started = False

    @property
    def seed(self) -> int:
        """Seed of the row."""
        return self._row.seed

    @property
    def time_s(self) -> float | None:
        """Simulation time [s]; None before the world exists."""
        return self.simulation.time_ns / NS_PER_S if self._has_started else None

    @property
    def is_over(self) -> bool:
        """True if a stop condition holds, or an event or measure failed."""
        return self._error is not None or (self._has_started and self.script.is_over)

    def world(self, world: World) -> World:
        """Assign the properties of the world and its models."""
        self._base = replace(world, models=())
        for property_ in self._properties:
            name = property_.path.split("/")[1] if property_.path.startswith(f"{_MODELS}/") else None
            if name is None or (name == "*" and world.models) or any(model.name == name for model in world.models):
                world = self._assigned(property_, world)
        return world

    def model(self, model: Model) -> Model:
        """Assign the properties of a spawned model."""
        assert self._base is not None
        world = replace(self._base, models=(model,))
        for property_ in self._properties:
            if property_.path.startswith((f"{_MODELS}/{model.name}/", f"{_MODELS}/*/")):
                world = self._assigned(property_, world)
        return world.models[0]

    def _assigned(self, property_: Property, world: World) -> World:
        try:
            world = property_.assigned(world)
        except UsageError as error:
            self._error = error
        self._unassigned.pop(property_.path, None)
        return world

    def start(self, simulation: Simulation, node: Node) -> None:
        """Prepare events and measures."""
        self.simulation = simulation
        reader = TopicReader(node, self._topics) if self._topics else None
        self.script = RunScript(self._plan, self._row, simulation, self._expressions, reader)
        simulation.on_reset(self.script.restart)
        self._has_started = True
        for period_ns in self.script.periods_ns:
            simulation.add_hook(_Act(self), period_ns=period_ns)

    def act(self) -> None:
        """Perform due events and samples; an error ends the run."""
        if self.is_over or not self._has_started:
            return
        try:
            self.script.act()
        except TrundleError as error:
            self._error = error

    def settle(self) -> bool:
        """Perform due events and samples; return `is_over`."""
        self.act()
        return self.is_over

    def finish(self) -> None:
        """Check the run at its end.

        Raises:
            TrundleError: an event, measure or property failed.
        """
        if self._error is not None:
            raise self._error
        if not self._has_started:
            raise UsageError("the launch has no world: none of its nodes is one of gazebo_ros")
        for property_ in self._unassigned.values():
            listed = ", ".join(repr(model.name) for model in self.simulation.models) or "none"
            raise UsageError(f"{property_.at}: error: {property_.path}: no such model was spawned; models: {listed}")


class _Act:
    """Hook that performs due events and samples."""

    def __init__(self, setup: LaunchSetup) -> None:
        self._setup = setup

    def before_step(self, _sim: Simulation, /) -> None:
        self._setup.act()
