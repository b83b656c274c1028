"""libfetch_gazebo_plugin.so: a robot's joints behind robot_controllers, as of fetch_gazebo."""

import asyncio
import math
from collections.abc import Callable
from typing import Self, cast

from trundle.base.diagnostics import TrundleError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import ParamError, RosParameters, TagParameters
from trundle.ros import Node
from trundle.sim.control import Servo
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from ..ros_control import ControllerContext, Interface, JointHardware, JointStateController
from .base import DiffDriveBase
from .gripper import ParallelGripper
from .mimic import ScaledMimic
from .trajectory import FollowJointTrajectory, PointHead

_CONTROLLERS = "/gazebo/default_controllers"
_POLL_S = 0.5
_LAG_STEPS = 5
_STATES_HZ = 100.0
_GRAVITY = "robot_controllers/GravityCompensation"
_INTERFACES: dict[str, tuple[Interface, dict[str, str]]] = {
    "robot_controllers/DiffDriveBaseController": (
        "VelocityJointInterface",
        {"l_wheel_joint": "l_wheel_joint", "r_wheel_joint": "r_wheel_joint"},
    ),
    "robot_controllers/ParallelGripperController": (
        "EffortJointInterface",
        {"l_gripper_joint": "l_gripper_finger_joint", "r_gripper_joint": "r_gripper_finger_joint"},
    ),
}
"""Type → interface of the joints that its parameters name, with their defaults; of others it is the position."""
_Controller = FollowJointTrajectory | ParallelGripper | DiffDriveBase | ScaledMimic | JointStateController
_MAKERS: dict[str, Callable[[ControllerContext, Callable[[], None]], _Controller]] = {
    "robot_controllers/DiffDriveBaseController": lambda context, _: DiffDriveBase(context),
    "robot_controllers/FollowJointTrajectoryController": FollowJointTrajectory,
    "robot_controllers/ParallelGripperController": ParallelGripper,
    "robot_controllers/PointHeadController": PointHead,
    "robot_controllers/ScaledMimicController": lambda context, _: ScaledMimic(context),
}


class FetchGazebo(Plugin):
    """Runs the controllers of the parameter /gazebo/default_controllers, and publishes /joint_states.

    Types of robot_controllers: FollowJointTrajectoryController, PointHeadController, ParallelGripperController,
    DiffDriveBaseController, ScaledMimicController; GravityCompensation is met by joints that hold still. A goal or
    `autostart` starts a controller, and stops those with its joints. Joints are driven by stiff motors, within their
    limits, without the gains of /gazebo.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag) -> None:
        TagParameters(tag.node, sim.report).report_unread()
        self._sim, self._model, self._node = sim, model, node
        self._joints: dict[str, JointHardware] = {}
        self._servo = Servo([])
        self._running: list[_Controller] = []
        self._is_ready = False
        node.loop.spawn(self._find_controllers())

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        if node is None:
            raise TrundleError("robot_controllers need the ROS graph, which --no-ros leaves out")
        return cls(sim, model, node, tag)

    def is_active(self) -> bool:
        """True once the controllers are known."""
        return self._is_ready

    def before_step(self, sim: Simulation) -> None:
        """Read joints, update controllers and write commands."""
        dt = self._servo.read(sim.time_ns, sim.step_ns)
        if dt <= 0.0:  # the first step after a reset
            return
        self._servo.update(dt)
        for controller in list(self._running):
            controller.update(sim.time_ns, dt)
        self._servo.write(dt)
        sim.engine.reader.invalidate()  # kinematic drives change velocities

    def step_action(self) -> tuple[Servo, float] | None:
        """Return the action that reads, updates and writes at every step, until a controller's next update is due."""
        due_ns = (controller.due_ns(self._sim.time_ns) for controller in self._running)
        return (self._servo, min(due_ns, default=math.inf)) if self._is_ready else None

    def finish_stride(self) -> None:
        """Settle goals that ended in a stride."""
        for controller in list(self._running):
            controller.finish_stride()

    def reset(self) -> None:
        """Hold the joints' current positions, and restart the controllers."""
        self._servo.restart(self._sim.time_ns)
        for joint in self._joints.values():
            joint.read()
            joint.stop()
            joint.command = joint.resting_command
        for controller in self._running:
            controller.stop()
            controller.start(self._sim.time_ns)

    async def _find_controllers(self) -> None:
        """Wait for the parameters, on the loop; then continue on the simulation's thread."""
        node, is_logged = self._node, False
        while not node.closed.is_set():
            names = await node.params.get(_CONTROLLERS, None)
            if isinstance(names, list):
                full = [f"/{str(name).strip('/')}" for name in cast("list[object]", names)]
                trees = [RosParameters(await node.params.get(name, {}), name) for name in full]
                assert node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
                node.deliver(lambda trees=trees: self._begin(trees))
                return
            if not is_logged:
                node.log.info(f"fetch_gazebo plugin is waiting for the controllers in parameter [{_CONTROLLERS}]")
                is_logged = True
            await asyncio.sleep(_POLL_S)

    def _begin(self, trees: list[RosParameters]) -> None:
        self._find_joints(trees)
        self._servo = Servo(list(self._joints.values()))
        self._servo.longest_ns = self._sim.step_ns
        self._servo.restart(self._sim.time_ns)
        self._sim.on_change(self._rebind)
        self._is_ready = True
        states = RosParameters({"publish_rate": _STATES_HZ}, "")
        self._start(JointStateController(self._context(states)))
        for settings in trees:
            try:
                self._load(settings)
            except ParamError as error:
                self._node.log.error(f"Could not load controller '{settings.namespace}': {error}")
        self._node.log.info("Finished initializing FetchGazeboPlugin")

    def _find_joints(self, trees: list[RosParameters]) -> None:
        interfaces: dict[str, Interface] = {}
        for settings in trees:
            interface, names = _INTERFACES.get(settings.text("type", ""), ("PositionJointInterface", {}))
            interfaces |= {settings.text(name, default): interface for name, default in names.items()}
        for handle in self._model.joints:
            if handle.is_driven:
                interface = interfaces.get(handle.name, "PositionJointInterface")
                joint = JointHardware(handle, interface, None, lag_s=self._lag_s)
                joint.read()
                joint.command = joint.resting_command
                self._joints[handle.name] = joint

    def _load(self, settings: RosParameters) -> None:
        """Make a controller, and start it if it starts by itself.

        Raises:
            ParamError: it cannot be made.
        """
        kind = settings.text("type")
        if kind == _GRAVITY:
            return
        if kind not in _MAKERS:
            raise ParamError(f"no controller of type {kind!r}; types: {', '.join(sorted([*_MAKERS, _GRAVITY]))}")
        made: list[_Controller] = []
        controller = _MAKERS[kind](self._context(settings), lambda: self._start(made[0]))
        made.append(controller)
        if settings.flag("autostart", default=False):
            self._start(controller)

    def _context(self, settings: RosParameters) -> ControllerContext:
        return ControllerContext(
            name=settings.namespace,
            namespace="",
            node=self._node,
            settings=settings,
            hardware=self._joints,
            model=self._model,
        )

    def _start(self, controller: _Controller) -> None:
        """Start a controller that does not run, and stop those with its joints."""
        if controller in self._running:
            return
        claimed = _claimed(controller)
        for other in [other for other in self._running if claimed & _claimed(other)]:
            other.stop()
            self._running.remove(other)
        for joint in self._joints.values():
            joint.read()
        controller.start(self._servo.time_ns)
        self._running.append(controller)
        self._servo.set_laws([law for one in self._running for law in one.laws])

    @property
    def _lag_s(self) -> float:
        return _LAG_STEPS * self._sim.step_ns / 1e9

    def _rebind(self) -> None:
        """Use the joints' new handles, and the new time step."""
        for joint in self._joints.values():
            if joint.handle.is_valid:
                joint.rebind()
            joint.lag_s = self._lag_s


def _claimed(controller: _Controller) -> set[str]:
    return {joint for joints in controller.claims.values() for joint in joints}
