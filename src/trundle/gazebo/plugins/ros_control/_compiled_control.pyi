"""Controllers and hardware of ros_control in compiled libraries."""

from collections.abc import Callable, Sequence

from trundle.sim.control import ServoHardware, ServoJoint, ServoLaw

def open_library(file: str) -> int:
    """Open a library and return its handle.

    Raises:
        RuntimeError: it cannot be opened.
    """

def kit_folder(library: int) -> str:
    """Return the folder of the kit's libraries that an opened library was compiled with.

    Raises:
        RuntimeError: it was not compiled with the kit.
    """

class CompiledRobot(ServoHardware):
    """Joints as compiled controllers see them."""

    @staticmethod
    def of_joints(library: int, joints: Sequence[tuple[str, int, ServoJoint]]) -> CompiledRobot:
        """Return a robot of the simulator's joints: name, interface and joint of each.

        Raises:
            RuntimeError: the library was compiled with another release.
        """

    @staticmethod
    def of_model(library: int, model: str) -> CompiledRobot:
        """Return the robot of a model's RobotHWSim.

        Raises:
            RuntimeError: the library was compiled with another release.
            ValueError: there is none.
        """

    @property
    def names(self) -> list[tuple[str, int]]:
        """Name and interface of a RobotHWSim's joints."""

    def connect(self, name: str, joint: ServoJoint) -> None:
        """Let a joint read and write the RobotHWSim's numbers of this name."""

    def stop(self, is_active: bool) -> None:
        """Begin or end an emergency stop."""

    def begin_stride(self) -> None:
        """Act again at times that it has acted at."""

    def checkpoint(self) -> Callable[[], None]:
        """Return a function after which repeated steps do not reach the hardware again."""

class CompiledLaw(ServoLaw):
    """A compiled controller."""

    def __init__(self, robot: CompiledRobot, class_name: str, root: str, name: str) -> None:
        """Make and initialize a controller.

        Args:
            robot: its joints.
            class_name: C++ class, of an opened library.
            root: namespace of the robot.
            name: name below it.

        Raises:
            RuntimeError: it was not made; the text says why.
        """

    @property
    def claims(self) -> list[tuple[str, str]]:
        """Claimed interfaces and resources."""

    def start(self, time_ns: int) -> str:
        """Start; return the reason for a failure, '' if there was none."""

    def stop(self, time_ns: int) -> str:
        """Stop; return the reason for a failure, '' if there was none."""

    def begin_stride(self) -> None:
        """Update again at times that it was updated at."""

    @property
    def failure(self) -> str:
        """Text of an exception, after which it is not updated; '' if there was none."""

    def checkpoint(self) -> Callable[[], None]:
        """Return a function after which repeated updates write the same commands."""
