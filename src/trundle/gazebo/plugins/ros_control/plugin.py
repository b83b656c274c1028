"""libgazebo_ros_control.so: a robot's joints behind ros_control's hardware interfaces."""

import asyncio
from typing import Self

from trundle.base.diagnostics import TrundleError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import RosParameters, TagParameters
from trundle.ros import Node
from trundle.sim.control import Servo
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from ._compiled_control import CompiledRobot
from .controller import Endpoints
from .gains import reconfigurable_pid
from .hardware import JointHardware
from .manager import ControllerManager
from .robot_hardware import connect_joints, find_hardware, load_hardware
from .transmissions import read_transmissions

_DEFAULT_SIM = "gazebo_ros_control/DefaultRobotHWSim"
_POLL_S = 0.5
_LAG_STEPS = 5
_LEGACY_PARAMETER = "legacyModeNS"


class GazeboRosControl(Plugin):
    """Reads the transmissions of `robotParam`, and runs a controller_manager in `robotNamespace`.

    Parameters: <robotNamespace> (the model's name), <robotParam> (robot_description), <robotSimType>
    (gazebo_ros_control/DefaultRobotHWSim, or a RobotHWSim in C++ that a package exports), <controlPeriod> [s] (the
    step), <eStopTopic>. Controllers are Trundle's, or those in C++ that packages export. In place of another hardware
    each joint of a transmission of several is driven by its own interface. A joint with gains on
    `gazebo_ros_control/pid_gains/<joint>` gets their efforts; others are driven by a stiff motor. Efforts are added to
    the other plugins' efforts on the joint; the later of two speeds counts; a position overrides both.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._sim = sim
        self._model = model
        self._node = node
        self._namespace = "/" + parameters.text("robotNamespace", model.name).strip("/")
        self._param = parameters.text("robotParam", "robot_description")
        kind = parameters.text("robotSimType", _DEFAULT_SIM) or _DEFAULT_SIM
        self._tag = tag
        self._is_default = kind == _DEFAULT_SIM
        self._robot_class = None if kind == _DEFAULT_SIM else find_hardware(kind, sim, model)
        if kind != _DEFAULT_SIM and self._robot_class is None:
            parameters.warn(
                f"robotSimType {kind!r}: no package exports it in a library that Trundle's kit has compiled, as "
                f"catkin_make does; {_DEFAULT_SIM} replaces it"
            )
        self._robot: CompiledRobot | None = None
        self.period_ns = _period_ns(parameters, sim)
        self._is_stopped = False
        self._held_commands: list[float] = []
        """Commands of all joints during an emergency stop."""
        stop_topic = parameters.text("eStopTopic", "")
        if stop_topic:
            node.subscribe(f"{self._namespace}/{stop_topic}", "std_msgs/Bool", lambda m: self._stop(m.data))
        parameters.ignore(_LEGACY_PARAMETER)
        parameters.report_unread()
        self._endpoints = Endpoints()
        self._hardware: dict[str, JointHardware] = {}
        self._servo = Servo([])
        self._manager: ControllerManager | None = None
        node.loop.spawn(self._find_robot())

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        if node is None:
            raise TrundleError("ros_control needs the ROS graph, which --no-ros leaves out")
        return cls(sim, model, node, tag)

    def is_active(self) -> bool:
        """True if there is a robot to control."""
        return self._manager is not None

    def before_step(self, sim: Simulation) -> None:
        """Read joints, update controllers and write commands."""
        servo, joints = self._servo, self._hardware.values()
        if self._robot is not None:
            self._robot.begin_stride()
        if self._manager is not None:
            self._manager.begin_stride()
        dt = servo.read(sim.time_ns, sim.step_ns)
        if dt <= 0.0 or self._manager is None:  # the first step after a reset
            return
        if self._held_commands and not self._is_stopped:
            self._held_commands = []
            self._manager.restart(sim.time_ns)
        servo.update(dt)
        self._manager.update(sim.time_ns, dt)
        if self._is_stopped:
            self._held_commands = self._held_commands or [joint.resting_command for joint in joints]
            for joint, command in zip(joints, self._held_commands, strict=True):
                joint.command = command
        servo.write(dt)
        sim.engine.reader.invalidate()  # kinematic drives change velocities

    def step_action(self) -> tuple[Servo, float] | None:
        """Return the action that reads, updates and writes at every step, until a controller's next update is due."""
        if self._manager is None or self._is_stopped or self._held_commands:
            return None
        due_ns = self._manager.due_ns(self._sim.time_ns)
        return None if due_ns is None else (self._servo, due_ns)

    def finish_stride(self) -> None:
        """Settle goals that ended in a stride."""
        if self._manager is not None:
            self._manager.finish_stride()

    def reset(self) -> None:
        """Hold the joints' current positions, and restart the controllers."""
        self._servo.restart(self._sim.time_ns)
        for joint in self._hardware.values():
            joint.read()
            joint.stop()
            joint.command = joint.resting_command
        self._held_commands = []
        if self._manager is not None:
            self._manager.restart(self._sim.time_ns)

    def _stop(self, is_stopped: bool) -> None:
        self._is_stopped = is_stopped
        if self._robot is not None:
            self._robot.stop(is_stopped)

    async def _find_robot(self) -> None:
        """Wait for the robot's description, on the loop; then continue on the simulation's thread."""
        node, is_logged = self._node, False
        name = f"{self._namespace}/{self._param}"
        while not node.closed.is_set():
            for candidate in (name, f"/{self._param}"):  # upwards from the robot's namespace, as searchParam
                text = await node.params.get(candidate, None)
                if isinstance(text, str) and text.strip():
                    gains = await node.params.get(f"{self._namespace}/gazebo_ros_control/pid_gains", {})
                    assert node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
                    node.deliver(lambda text=text, name=candidate, gains=gains: self._begin(text, name, gains))
                    return
            if not is_logged:
                node.log.info(f"gazebo_ros_control plugin is waiting for model URDF in parameter [{name}]")
                is_logged = True
            await asyncio.sleep(_POLL_S)

    def _begin(self, urdf: str, name: str, gains: object) -> None:
        settings = RosParameters(gains, f"{self._namespace}/gazebo_ros_control/pid_gains")
        try:
            if self._robot_class is None:
                self._find_joints(urdf, name, settings)
            else:
                self._robot = load_hardware(
                    self._sim,
                    self._model,
                    self._node,
                    self._tag,
                    self._robot_class,
                    namespace=self._namespace,
                    urdf=urdf,
                )
                self._hardware = connect_joints(self._robot, self._model, lag_s=self._lag_s)
        except TrundleError as error:
            self._node.log.fatal(f"gazebo_ros_control: {error}; no joint is controlled")
            return
        self._servo = Servo(list(self._hardware.values()))
        self._servo.set_hardware(self._robot)
        self._servo.longest_ns = self.period_ns  # the state may be older than the last read after a reset is undone
        self._servo.restart(self._sim.time_ns)
        self._sim.on_change(self._rebind)
        self._manager = ControllerManager(
            self._node,
            self._namespace,
            self._hardware,
            self._servo,
            self._model,
            robot=self._robot,
            world_file=self._sim.world.at.file,
        )
        self._node.log.info(f"Loaded gazebo_ros_control: {len(self._hardware)} joints of {self._namespace}")

    def _find_joints(self, urdf: str, name: str, gains: RosParameters) -> None:
        """Make the default hardware's joints."""
        for driven in read_transmissions(urdf, name, self._sim.report, drives_groups=not self._is_default):
            handle = self._model.joint(driven.name)
            if not handle.is_driven:
                self._node.log.warn(f"joint {driven.name!r} has no axis to drive; its transmission is left out")
                continue
            settings = gains.section(driven.name)
            has_gains = "p" in settings and driven.interface != "EffortJointInterface"
            pid = reconfigurable_pid(self._node, settings, self._endpoints) if has_gains else None
            joint = JointHardware(handle, driven.interface, pid, lag_s=self._lag_s)
            joint.read()
            joint.command = joint.resting_command
            self._hardware[driven.name] = joint

    @property
    def _lag_s(self) -> float:
        return max(_LAG_STEPS * self._sim.step_ns, 1.5 * self.period_ns) / 1e9

    def _rebind(self) -> None:
        """Use the joints' new handles, and the new time step."""
        for joint in self._hardware.values():
            if joint.handle.is_valid:
                joint.rebind()
            joint.lag_s = self._lag_s


def _period_ns(parameters: TagParameters, sim: Simulation) -> int:
    """Period of <controlPeriod> [ns], at least one step."""
    period_ns = round(parameters.number("controlPeriod", 0.0) * 1e9)
    if 0 < period_ns < sim.step_ns:
        parameters.warn(f"controlPeriod {period_ns / 1e9:g} s is less than a step; one step is used")
    return max(period_ns, sim.step_ns)
