"""libKeysToJointsPlugin.so: joint commands from keys."""

from dataclasses import dataclass
from typing import Self

from trundle.base.diagnostics import UsageError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.control import Pid
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from .joint_controller import ControlledJoint
from .key_topic import subscribe_keys

_REQUIRED = ("key", "scale", "type")


@dataclass(frozen=True, slots=True)
class _Key:
    joint: ControlledJoint
    kind: str
    scale: float


class KeysToJoints(Plugin):
    """Commands joints by keys, from the topic of `trundle.gazebo.plugins.gazebo.key_topic`.

    Parameters, of any number of <map key="…" scale="…" type="…" kp="0" ki="0" kd="0">: <joint>. Type position: each
    press sets the target to the joint's position plus scale [rad or m]; velocity: scale is the target [rad/s or m/s];
    force: one step of effort [N·m or N]. The integral term is zero, as in Gazebo, which leaves its limits at zero.
    """

    def __init__(self, model: ModelHandle, tag: PluginTag, sim: Simulation) -> None:
        self._joints: dict[str, ControlledJoint] = {}
        self._keys: dict[int, list[_Key]] = {}
        parameters = TagParameters(tag.node, sim.report)
        for entry in parameters.sections("map"):
            self._read(entry, model)
        parameters.report_unread()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        plugin = cls(model, tag, sim)
        subscribe_keys(node, tag, plugin.on_key, sim.report)
        return plugin

    def on_key(self, key: int) -> None:
        """Handle a key."""
        for binding in self._keys.get(key, ()):
            match binding.kind:
                case "position":
                    binding.joint.command_position(binding.joint.joint.position + binding.scale)
                case "velocity":
                    binding.joint.command_velocity(binding.scale)
                case _:
                    binding.joint.apply_effort(binding.scale)

    def before_step(self, sim: Simulation) -> None:
        """Apply the efforts."""
        for joint in self._joints.values():
            joint.update(sim)

    def reset(self) -> None:
        """Clear the commands."""
        for joint in self._joints.values():
            joint.clear()

    def _read(self, entry: TagParameters, model: ModelHandle) -> None:
        values = {name: entry.attribute(name) for name in (*_REQUIRED, "kp", "ki", "kd")}
        missing = [name for name in _REQUIRED if not values[name]]
        kind = values["type"]
        try:
            numbers = {name: float(values[name] or 0.0) for name in values if name != "type"}
            joint = model.joint(entry.text("joint"))
        except (ValueError, UsageError) as error:
            entry.warn(f"<map>: {error}; it is left out")
            return
        if missing or kind not in ("position", "velocity", "force") or not joint.axes:
            problem = (
                f"needs {', '.join(missing)}" if missing else f"type {kind!r} of a joint with {len(joint.axes)} axes"
            )
            entry.warn(f"<map>: {problem}; it is left out")
            return
        controlled = self._joints.setdefault(joint.name, ControlledJoint(joint))
        pid = Pid(p=numbers["kp"], i=numbers["ki"], d=numbers["kd"])
        if kind == "position":
            controlled.command_position(None, pid)
        elif kind == "velocity":
            controlled.command_velocity(None, pid)
        self._keys.setdefault(int(numbers["key"]), []).append(_Key(controlled, kind, numbers["scale"]))
