"""librotors_gazebo_motor_model.so: thrust, drag and torques of a rotor."""

import math
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.control import Pid
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Vector3, Wrench

from ..gazebo_ros.ros_plugin import RosPlugin
from .namespaces import read_topic_name

if TYPE_CHECKING:
    from trundle.ros.message_types import mav_msgs, rotors_comm

_DIRECTIONS = {"cw": -1.0, "ccw": 1.0}
_GAINS = (
    ("p", "p"),
    ("i", "i"),
    ("d", "d"),
    ("i_max", "iMax"),
    ("i_min", "iMin"),
    ("high", "cmdMax"),
    ("low", "cmdMin"),
)
Kind = Literal["velocity", "position", "force"]


class MotorModel(RosPlugin):
    """Reads mav_msgs/Actuators; the value at <motorNumber> is a speed [rad/s], an angle [rad] or an effort [N·m].

    Parameters, with RotorS' defaults: <robotNamespace>, <jointName>, <linkName>, <turningDirection> cw or ccw
    (required), <motorNumber> 0, <motorType> velocity, position (by <joint_control_pid>) or force; of velocity
    <maxRotVelocity> 838 [rad/s], <motorConstant> 8.54858e-6 [N·s²/rad²], <momentConstant> 0.016 [m],
    <timeConstantUp> 1/80 and <timeConstantDown> 1/40 [s], <rotorDragCoefficient> 1e-4, <rollingMomentCoefficient> 1e-6
    and <rotorVelocitySlowdownSim> 10: rotor speed over joint speed. Topics: <commandSubTopic>
    command/motor_speed, <windSpeedSubTopic> wind_speed (rotors_comm/WindSpeed), <motorSpeedPubTopic> motor_speed, and
    if given <motorPositionPubTopic> and <motorForcePubTopic> (std_msgs/Float32, of the joint).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)

        self._node = node
        self._joint = model.joint(parameters.text("jointName"))
        self._link = model.link(parameters.text("linkName"))
        if not self._joint.is_driven:
            raise UsageError(f"joint {self._joint.name!r} has no axis to drive")
        axis, parent = self._joint.joint.axis, self._joint.joint.parent
        assert axis is not None, f"{self._joint.name} moves"
        self._axis = self._link.link.model_from_link.inverse().transform_vector(axis.direction)
        """Joint axis in the rotor's frame."""
        self._parent = None if parent == "world" else model.link(parent)
        self._number = parameters.integer("motorNumber", 0)
        direction = parameters.text("turningDirection", "")
        if direction not in _DIRECTIONS:
            raise UsageError(f"<turningDirection> is cw or ccw, got {direction!r}")
        self._direction = _DIRECTIONS[direction]
        self._kind = _read_kind(parameters)
        self._pid = _read_pid(parameters.section("joint_control_pid"))
        self._max_speed = parameters.number("maxRotVelocity", 838.0)
        self._motor_constant, self._moment_constant = (
            parameters.number("motorConstant", 8.54858e-6),
            parameters.number("momentConstant", 0.016),
        )
        self._time_constant_up, self._time_constant_down = (
            parameters.number("timeConstantUp", 1 / 80, above=0.0),
            parameters.number("timeConstantDown", 1 / 40, above=0.0),
        )
        self._drag, self._roll = (
            parameters.number("rotorDragCoefficient", 1e-4),
            parameters.number("rollingMomentCoefficient", 1e-6),
        )
        self._slowdown = parameters.number("rotorVelocitySlowdownSim", 10.0, above=0.0)
        self._wind = np.zeros(3)
        node.subscribe(
            read_topic_name(parameters, "commandSubTopic", "command/motor_speed"),
            "mav_msgs/Actuators",
            self._on_command,
        )
        node.subscribe(
            read_topic_name(parameters, "windSpeedSubTopic", "wind_speed"), "rotors_comm/WindSpeed", self._on_wind
        )
        topics = {"motorSpeedPubTopic": "motor_speed"} | {
            name: "" for name in ("motorPositionPubTopic", "motorForcePubTopic") if name in parameters
        }
        self._topics = {
            name: node.advertise(read_topic_name(parameters, name, default), "std_msgs/Float32", queue_size=1)
            for name, default in topics.items()
        }
        self._clear()

    def before_step(self, sim: Simulation) -> None:
        """Apply the rotor's forces, and drive the joint."""
        dt = sim.step_ns / 1e9
        if self._kind == "velocity":
            self._apply_forces()
            time_constant = self._time_constant_up if self._command > self._speed else self._time_constant_down
            decay = math.exp(-dt / time_constant)
            self._speed = decay * self._speed + (1.0 - decay) * self._command
            self._joint.set_velocity(self._direction * self._speed / self._slowdown)
        elif self._kind == "position":
            error = math.remainder(self._joint.position - self._command, math.tau)
            self._joint.command_effort(self._pid.command(error, dt))
        else:
            self._joint.command_effort(self._command)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the joint's speed, position and effort."""
        del snapshot
        joint = self._joint
        for name, topic in self._topics.items():
            if topic.has_subscribers:
                values = {"motorSpeedPubTopic": joint.velocity, "motorPositionPubTopic": joint.position}
                topic.publish({"data": values.get(name, joint.effort)})

    def reset(self) -> None:
        """Stop the rotor."""
        self._clear()

    def _clear(self) -> None:
        self._command = self._speed = 0.0
        self._pid.reset()

    def _apply_forces(self) -> None:
        """Apply thrust along the rotor's z axis; drag and rolling moment by P. Martin and E. Salaün, The true role of
        accelerometer feedback in quadrotor control (ICRA 2010)."""
        pose, rate = self._link.pose, self._joint.velocity * self._slowdown
        thrust = self._direction * math.copysign(rate * rate * self._motor_constant, rate)
        axis = np.array(pose.transform_vector(self._axis))
        airspeed = np.array(self._link.twist.linear) - self._wind
        radial_velocity = airspeed - (airspeed @ axis) * axis
        self._link.add_wrench(
            Wrench(_sum(pose.transform_vector((0.0, 0.0, thrust)), -abs(rate) * self._drag * radial_velocity))
        )
        if self._parent is not None:
            torque = pose.transform_vector((0.0, 0.0, -self._direction * thrust * self._moment_constant))
            self._parent.add_wrench(Wrench(torque=_sum(torque, -abs(rate) * self._roll * radial_velocity)))

    def _on_command(self, message: "mav_msgs.Actuators") -> None:
        values = message.angular_velocities
        if not 0 <= self._number < len(values):
            self._node.log.error(f"motor {self._number}: the command is for {len(values)} motors")
            return
        command = float(values[self._number])
        if math.isfinite(command):
            self._command = min(command, self._max_speed) if self._kind == "velocity" else command

    def _on_wind(self, message: "rotors_comm.WindSpeed") -> None:
        wind = np.array([message.velocity.x, message.velocity.y, message.velocity.z], dtype=float)
        if np.isfinite(wind).all():
            self._wind = wind


def _read_kind(parameters: TagParameters) -> Kind:
    match parameters.text("motorType", "velocity"):
        case "velocity" | "position" | "force" as kind:
            return kind
        case other:
            raise UsageError(f"<motorType> is velocity, position or force, got {other!r}")


def _read_pid(parameters: TagParameters) -> Pid:
    """Gains and limits; all default to 0, the command's limits as well."""
    return Pid(**{field: parameters.number(name, 0.0) for field, name in _GAINS})


def _sum(vector: Vector3, offset: NDArray[np.float64]) -> Vector3:
    x, y, z = (np.array(vector) + offset).tolist()
    return x, y, z
