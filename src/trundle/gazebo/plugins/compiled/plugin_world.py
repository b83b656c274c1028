"""The compiled plugins of a simulation, called in C++ before each step."""

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self
from weakref import WeakKeyDictionary, WeakValueDictionary, finalize, ref

from trundle.base.diagnostics import DescriptionError, Source, TrundleError
from trundle.robots.model import PluginTag
from trundle.sim.physics import StepAction, mujoco_addresses
from trundle.sim.simulation import Simulation, Snapshot

from ._plugin_host import PluginHost
from .elements import elements_of, model_elements, world_elements
from .requests import perform

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from trundle.ros import Node
    from trundle.sim.sensors import CameraSensor

_FUNCTIONS = ("mj_kinematics", "mj_comPos", "mj_comVel", "mj_contactForce", "mj_rnePostConstraint")
_NODE = "gazebo_plugins"
"""Name of the node of all compiled plugins: a process of roscpp is one node."""


class CompiledPlugins:
    """All compiled plugins of a simulation: a hook that acts in C++ at every step."""

    def __init__(self, sim: Simulation) -> None:
        self._sim = ref(sim)
        self._at = sim.world.at
        self._host = PluginHost(mujoco_addresses(_FUNCTIONS), sim.world.name, world_elements(sim.world))
        self._positions: dict[str, Source] = {}
        """Beginning of a plugin's warnings → its element."""
        self._models: list[str] = []
        self.cameras: WeakValueDictionary[str, CameraSensor] = WeakValueDictionary()
        """`model::link::sensor` → camera with a plugin."""
        self._has_requests = False
        self._follow_world()
        sim.on_change(self._follow_world)
        sim.on_reset(self._reset_world)
        sim.add_hook(self, name="C++ plugins")
        finalize(self, _close, self._host)

    @classmethod
    def of(cls, sim: Simulation) -> Self:
        """Return the plugins of a simulation."""
        if sim not in _PLUGINS:
            _PLUGINS[sim] = cls(sim)
        plugins = _PLUGINS[sim]
        assert isinstance(plugins, cls)
        plugins._follow_world()
        return plugins

    def load(self, library: Path, tag: PluginTag, parent: str, node: "Node | None") -> int:
        """Load a plugin, and return its number.

        Args:
            library: its file.
            tag: its element.
            parent: name of its model or world.
            node: a node of the graph that the plugin's may join; None: without ROS.

        Raises:
            DescriptionError: it cannot be loaded, or its Load threw an exception.
        """
        self._positions[f"plugin {tag.name!r}:"] = tag.at
        try:
            handle = self._host.open(str(library))
            if node is not None:
                self._host.start_ros(handle, node.master_uri, _NODE)
            number = self._host.load(handle, parent, tag.name, tag.filename, elements_of(tag.node))
        except RuntimeError as error:
            what = f"plugin {tag.name!r}: {library}: {_first_line(error)}"
            raise DescriptionError(tag.at, what, "compiled-plugin") from None
        self._finish_calls()
        return number

    def wants_reading(self, number: int) -> bool:
        """Return whether a sensor's plugin wants readings."""
        return self._host.wants_reading(number)

    def give_reading(
        self,
        number: int,
        time_ns: int,
        values: "NDArray[np.float64]",
        image: "NDArray[np.uint8] | None",
        depths: "NDArray[np.float32] | None",
        contacts: list[Any],
    ) -> None:
        """Give a sensor's plugin a reading; see `PluginHost.take_reading`."""
        self._host.take_reading(number, time_ns, values, image, depths, contacts)
        self._finish_calls()

    def _reset_world(self) -> None:
        self.reset(0)

    def reset(self, number: int) -> None:
        """Call a plugin's Reset; 0: clear the commands of all, before their resets."""
        self._host.reset(number)
        self._finish_calls()

    def before_step(self, sim: Simulation) -> None:
        """Act before the first step of a stride."""
        self._host.begin_stride()
        self._host.act(sim.time_ns, sim.step_ns)
        self._finish_calls()

    def step_action(self) -> tuple[StepAction, float]:
        """Return what acts before all other steps; requests end the stride after its first step."""
        sim = self._sim()
        assert sim is not None
        return self._host, sim.time_ns + sim.step_ns if self._has_requests else math.inf

    def finish_stride(self) -> None:
        """Do what the plugins asked for."""
        self._has_requests = False
        self._host.finish_stride()
        self._finish_calls()

    def after_step(self, snapshot: Snapshot) -> None:
        """Do nothing: the plugins' ends of a step are called with the next one's beginning."""

    after_step.__dict__["does_nothing"] = True

    def _finish_calls(self) -> None:
        sim = self._sim()
        if sim is None:
            return
        has_changed, has_moved = self._host.take_changes()
        if has_changed:
            sim.engine.state_written(moved=has_moved)
        for text in self._host.take_warnings():
            named = (at for start, at in self._positions.items() if text.startswith(start))
            sim.report.warn(next(named, self._at), text, "compiled-plugin")
        for words, numbers in self._host.take_requests():
            self._has_requests = True
            sim.post(lambda sim, words=words, numbers=numbers: self._perform(sim, words, numbers))

    def _perform(self, sim: Simulation, words: list[str], numbers: list[float]) -> None:
        try:
            if words[0] == "border_crop":
                if (camera := self.cameras.get(words[1])) is not None:
                    camera.set_crop(numbers[0] != 0.0)
            else:
                perform(sim, words, numbers)
        except TrundleError as error:
            sim.report.warn_error(
                error, self._at, "a compiled plugin asked for it", "compiled-plugin", subject="plugin"
            )

    def _follow_world(self) -> None:
        """Continue with the current world's models and arrays."""
        sim = self._sim()
        if sim is None:
            return
        engine = sim.engine
        compiled = engine.compiled
        links = list(zip(compiled.link_names, compiled.link_bodies.tolist(), strict=True))
        axes = list(
            zip(
                compiled.axis_qpos.tolist(),
                compiled.axis_dof.tolist(),
                compiled.axis_sign.tolist(),
                (compiled.axis_actuator >= 0).tolist(),
                strict=True,
            )
        )
        joints = [
            (name, [(axis, *axes[axis]) for axis in span], *anchor)
            for name, span, anchor in zip(
                compiled.joint_names, compiled.joint_axes, compiled.joint_anchors, strict=True
            )
        ]
        self._host.bind(*engine.addresses, engine.motors.bank, links, joints, compiled.geom_collisions)
        names = [model.name for model in sim.world.models]
        for name in [name for name in self._models if name not in names]:
            self._host.remove_model(name)
        for model in sim.world.models:
            if model.name not in self._models:
                self._host.add_model(model.name, model_elements(sim.world, model))
        self._models = names


_PLUGINS: WeakKeyDictionary[Simulation, CompiledPlugins] = WeakKeyDictionary()


def _first_line(error: Exception) -> str:
    return str(error).splitlines()[0] if str(error) else type(error).__name__


def start_ros(library: int, node: "Node") -> None:
    """Let an opened library use ROS: this process becomes a node of roscpp."""
    PluginHost.start_ros(library, node.master_uri, _NODE)


def _close(host: PluginHost) -> None:
    """Destroy the plugins, and so end their threads, before the world or the process does."""
    sys.stdout.flush()
    host.close()
