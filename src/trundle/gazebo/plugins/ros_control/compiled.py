"""Controllers of users' packages in C++, which run in the servo beside all others."""

from typing import Self

from trundle.robots.parameters import ParamError

from ..compiled import start_ros
from ._compiled_control import CompiledLaw, CompiledRobot, open_library
from .controller import ControllerContext, InStepController
from .exported_class import ExportedClass, library_of
from .hardware import INTERFACE_NUMBERS, Hardware
from .transmissions import Interface


class CompiledRobots:
    """A robot's joints as compiled controllers see them, made on first use."""

    def __init__(self, hardware: Hardware, robot: CompiledRobot | None) -> None:
        """Create for joints; `robot`: that of a RobotHWSim, which all controllers use."""
        self._hardware = hardware
        self._robot = robot

    def robot(self, library: int) -> CompiledRobot:
        """Return the robot for the controllers of an opened library."""
        if self._robot is None:
            joints = [(joint.name, INTERFACE_NUMBERS[joint.interface], joint) for joint in self._hardware.values()]
            self._robot = CompiledRobot.of_joints(library, joints)
        return self._robot


class CompiledController(InStepController):
    """Controller in C++: its update runs at every step, its callbacks in threads of roscpp."""

    def __init__(self, context: ControllerContext, robots: CompiledRobots, found: ExportedClass) -> None:
        name = context.name.removeprefix(f"{context.namespace}/")
        try:
            library = open_library(str(library_of(found)))
            start_ros(library, context.node)
            self._law = CompiledLaw(robots.robot(library), found.type, context.namespace or "/", name)
        except RuntimeError as error:
            raise ParamError(f"{found.library}: {' '.join(str(error).split())}") from None
        self._node = context.node
        self._name = name
        self.laws = (self._law,)
        self.claims: dict[Interface | str, list[str]] = {}
        for interface, resource in self._law.claims:
            self.claims.setdefault(interface.removeprefix("hardware_interface::"), []).append(resource)
        names = {resource for resources in self.claims.values() for resource in resources}
        self._joints = [joint for name, joint in context.hardware.items() if name in names]
        self._is_reported = False

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`; the manager makes it by its class, instead."""
        raise NotImplementedError

    def start(self, time_ns: int) -> None:
        """Start it."""
        self._is_reported = False
        for joint in self._joints:
            joint.start()
        self._log(self._law.start(time_ns))

    def begin_stride(self) -> None:
        """Update again at times that it was updated at."""
        self._law.begin_stride()

    def finish_stride(self) -> None:
        """Report an exception of its update, after which its joints rest."""
        if self._law.failure and not self._is_reported:
            self._is_reported = True
            self._log(f"{self._law.failure}; it is not updated again until it is restarted")
            for joint in self._joints:
                joint.stop()

    def stop(self) -> None:
        """Stop it."""
        self._log(self._law.stop(self._law.time_ns))
        for joint in self._joints:
            joint.stop()

    def close(self) -> None:
        """Destroy it, with its topics."""
        self.laws = ()
        del self._law

    def _log(self, fault: str) -> None:
        if fault:
            self._node.log.error(f"controller '{self._name}': {fault}")
