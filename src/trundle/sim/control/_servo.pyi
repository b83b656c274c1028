"""Laws of ros_control in C++, which act before each step of the engine."""

from collections.abc import Callable, Sequence
from typing import TypeAlias

from trundle.sim.physics import MotorAxis, StepAction

_State: TypeAlias = tuple[float, float, float]
_Limits: TypeAlias = tuple[float, float, float, float, float, float]
_Segment: TypeAlias = tuple[int, int, tuple[float, ...], int, tuple[float, float, float, float], int]

class ToolboxPid:
    """PID controller for error = desired − actual, with control_toolbox's gains."""

    p: float
    i: float
    d: float
    i_clamp: float
    """Limit of the integral term's magnitude."""
    antiwindup: bool
    """True if the integral itself is clamped; else only its contribution."""

    def __init__(
        self, *, p: float = 0.0, i: float = 0.0, d: float = 0.0, i_clamp: float = 0.0, antiwindup: bool = False
    ) -> None: ...
    def reset(self) -> None:
        """Clear the integral and the last error."""

    def command(self, error: float, dt: float, *, slope: float | None = None) -> float:
        """Return the command, dt [s] after the last one.

        Args:
            error: desired − actual.
            dt: time since the last command [s].
            slope: derivative of the error [1/s]; None: difference from the last error, which is 0 at first.
        """

    def checkpoint(self) -> Callable[[], None]:
        """Save the gains and the integral; return a function that restores them."""

class ServoJoint:
    """Joint behind a hardware interface: a state to read, and a command to write."""

    command: float
    """Command [N·m or N], [rad or m] or [rad/s or m/s], by the interface."""
    lag_s: float
    """Time constant of driven positions [s]."""

    def __init__(
        self,
        axis: MotorAxis,
        interface: int,
        pid: ToolboxPid | None,
        *,
        lag_s: float,
        range: tuple[float, float],
        max_effort: float,
        max_speed: float,
        is_continuous: bool,
        is_prismatic: bool,
    ) -> None:
        """Command zero.

        Args:
            axis: engine's axis.
            interface: meaning of commands: effort 0, velocity 1, position 2.
            pid: efforts from position or velocity errors; None: position or velocity is driven directly.
            lag_s: time constant of driven positions [s].
            range: limits of positions [rad or m].
            max_effort: effort limit of a driven velocity [N·m or N].
            max_speed: limit of velocities and driven positions [rad/s or m/s].
            is_continuous: True for a revolute joint without limits.
            is_prismatic: True for a prismatic joint.
        """

    def bind(self, axis: MotorAxis) -> None:
        """Use an axis of another engine from now on, after the world was recompiled."""

    @property
    def position(self) -> float:
        """Position at the last `read` [rad or m]."""

    @property
    def velocity(self) -> float:
        """Velocity at the last `read` [rad/s or m/s]."""

    @property
    def effort(self) -> float:
        """Effort at the last `read` [N·m or N]."""

    @property
    def lower(self) -> float: ...
    @property
    def upper(self) -> float: ...
    @property
    def is_continuous(self) -> bool:
        """True if it is a revolute joint without limits."""

    @property
    def settling_ns(self) -> int:
        """Time for a driven position to settle [ns]; gazebo_ros_control sets the position at once."""

    @property
    def resting_command(self) -> float:
        """Command that holds the position read last, or zero effort or velocity."""

    def read(self) -> None:
        """Read position, velocity and effort."""

    def error(self, position: float) -> float:
        """Return a position minus the joint's [rad or m]; the shorter way round if the joint is continuous."""

    def shortest_error(self, position: float) -> float:
        """Return a position minus the joint's [rad or m]; the shorter way round unless the joint is prismatic, as in
        joint_trajectory_controller.
        """

    def stop(self) -> None:
        """Command zero effort, zero velocity, or the last position."""

    def start(self) -> None:
        """Command the current position, or zero, until the controller writes."""

    def write(self, dt: float) -> None:
        """Apply the command for a control period [s]."""

    def checkpoint(self) -> Callable[[], None]:
        """Save the joint's state and its PID's; return a function that restores them."""

class ServoLaw:
    """Law that commands joints at every step."""

    @property
    def time_ns(self) -> int:
        """Time of the last update [ns]."""

    @property
    def period_ns(self) -> int:
        """Control period of the last update [ns]; 0 before the first."""

    def update(self, time_ns: int, dt: float) -> bool:
        """Command the joints after a `read`, dt [s] after the last time; return False at an event."""

    def checkpoint(self) -> Callable[[], None]:
        """Save the law's state; return a function that restores it."""

class PidLoop(ServoLaw):
    """PID loop around one joint."""

    target: float
    """Position [rad or m], or velocity [rad/s or m/s]."""

    def __init__(self, joint: ServoJoint, pid: ToolboxPid, of_speed: bool) -> None: ...
    def start(self, time_ns: int) -> None:
        """Hold the current position, or zero velocity."""

    def error(self) -> float:
        """Return the error of the value, with the target within the joint's limits."""

    @property
    def updates(self) -> int:
        """Number of updates."""

class TrajectoryLaw(ServoLaw):
    """Follows a path with each joint, and checks the tolerances of an action's goal."""

    watches: bool
    """True while the goal is neither reached nor failed."""

    def __init__(self, joints: Sequence[ServoJoint], pids: Sequence[ToolboxPid], forward: Sequence[float]) -> None:
        """Create without paths; call `set_paths` before the first update.

        Args:
            joints: controller's joints.
            pids: PID controller of each joint; empty: positions are commanded.
            forward: gains of the desired velocities.
        """

    def set_paths(self, paths: Sequence[Sequence[_Segment]]) -> None:
        """Follow a path with each joint.

        Args:
            paths: segments, each of start and end [ns], coefficients, number of the goal, tolerances of position and
                velocity on the way and at the end, and the time after the end in which to reach the goal [ns].
        """

    def begin_goal(self, goal: int) -> None:
        """Start to watch the goal of this number; no joint has reached it yet."""

    def take_event(self) -> tuple[int, int, float] | None:
        """Return the result of the watched goal once: error code, joint and its position error [rad or m]."""

    @property
    def desired(self) -> list[_State]:
        """Position, velocity and acceleration of each joint at the last update."""

    def start(self, time_ns: int) -> None:
        """Set the desired states to the joints' current states."""

class DiffDriveLaw(ServoLaw):
    """Wheel speeds of diff_drive_controller from a body twist, and odometry from wheel positions."""

    def __init__(
        self,
        left: Sequence[ServoJoint],
        right: Sequence[ServoJoint],
        *,
        wheel_radius: float,
        separation: float,
        radii: tuple[float, float],
        limits: Sequence[_Limits],
        timeout_ns: int,
        open_loop: bool,
        window: int,
    ) -> None:
        """Start at the origin of the odometry.

        Args:
            left: wheels.
            right: wheels.
            wheel_radius: nominal radius [m].
            separation: distance between the wheels [m].
            radii: effective radii of left and right wheels [m].
            limits: smallest and largest velocity, acceleration and jerk, for forward motion and for turning.
            timeout_ns: age from which on a command is zero [ns].
            open_loop: True if the odometry is from the commands.
            window: number of speeds kept.
        """

    def start(self) -> None:
        """Stop, and integrate odometry from the current wheel positions."""

    def set_command(self, stamp_ns: int, linear: float, angular: float) -> None:
        """Drive with a speed [m/s] and yaw rate [rad/s], commanded at a time [ns]."""

    @property
    def pose(self) -> _State:
        """x, y [m] and yaw [rad] of the odometry."""

    @property
    def speeds(self) -> list[tuple[float, float]]:
        """Speed [m/s] and yaw rate [rad/s] of the last updates, the latest at the end."""

    @property
    def limited(self) -> tuple[float, float]:
        """Speed [m/s] and yaw rate [rad/s] that the wheels have been commanded, within the limits."""

class GripperLaw(ServoLaw):
    """Moves a finger until it arrives or stalls."""

    watches: bool
    """True while the goal is neither reached nor failed."""

    def __init__(
        self, joint: ServoJoint, pid: ToolboxPid | None, *, tolerance: float, min_speed: float, stall_ns: int
    ) -> None:
        """Stand still.

        Args:
            joint: finger's joint.
            pid: efforts from the position's error; None: the position is commanded.
            tolerance: error below which the goal is reached [rad or m].
            min_speed: speed below which the finger does not move [rad/s or m/s].
            stall_ns: time without motion after which it has stalled [ns].
        """

    def start(self, time_ns: int) -> None:
        """Hold the current position."""

    def begin(self, target: float, max_effort: float, time_ns: int) -> None:
        """Move to a position [rad or m] from a time on, with at most an effort [N·m or N]; 0: unlimited."""

    def hold(self) -> None:
        """Stay at the current position."""

    def take_event(self) -> bool | None:
        """Return the result of the watched goal once: True if it was reached, False if the finger stalled."""

class ServoHardware:
    """What reads and drives joints in place of the engine."""

class Servo(StepAction):
    """Joints of a robot, with the laws that command them; acts before each step."""

    longest_ns: int
    """Longest control period, within a step [ns]."""

    def __init__(self, joints: Sequence[ServoJoint]) -> None: ...
    def set_laws(self, laws: Sequence[ServoLaw]) -> None:
        """Run the given laws from now on."""

    def set_hardware(self, hardware: ServoHardware | None) -> None:
        """Read and write by this hardware, too; None: by the engine alone."""

    def restart(self, time_ns: int) -> None:
        """Begin a control period now."""

    def read(self, time_ns: int, step_ns: int) -> float:
        """Read the joints; return the time since the last read [s], 0 if it was at this time."""

    def update(self, dt: float) -> bool:
        """Run the laws, dt [s] after the last time; return False at an event."""

    def write(self, dt: float) -> None:
        """Apply all commands."""

    @property
    def time_ns(self) -> int:
        """Time of the last read [ns]."""

class MimicAction(StepAction):
    """Holds a joint at a multiple of another's position, by a motor; acts before each step."""

    def __init__(
        self,
        leader: MotorAxis,
        follower: MotorAxis,
        *,
        multiplier: float,
        offset: float,
        min_error: float,
        max_effort: float,
        lag_steps: int,
    ) -> None:
        """Hold follower = multiplier · leader + offset.

        Args:
            leader: leading axis.
            follower: following axis.
            multiplier: factor of the leader's position.
            offset: offset [rad or m].
            min_error: smaller errors are ignored [rad or m].
            max_effort: motor's effort limit [N·m or N].
            lag_steps: number of steps in which an error is corrected.
        """
