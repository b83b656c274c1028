"""Interface of controllers."""

from collections.abc import Sequence
from typing import Protocol

from .joint_path import JointPath
from .outcome import Outcome


class Controller(Protocol):
    """Executes paths of its joints."""

    @property
    def name(self) -> str:
        """Name, as in controller_list."""
        ...

    @property
    def joints(self) -> Sequence[str]:
        """Joints that it moves."""
        ...

    @property
    def is_default(self) -> bool:
        """True: preferred where several controllers move the same joints."""
        ...

    @property
    def is_active(self) -> bool:
        """True if it takes commands now."""
        ...

    async def execute(self, path: JointPath) -> Outcome:
        """Execute a path of some of its joints; cancelling the call stops the motion."""
        ...


class ControllerSource(Protocol):
    """Where controllers come from: a list of parameters, or a controller manager."""

    async def controllers(self) -> Sequence[Controller]:
        """Return the present controllers."""
        ...

    async def activate(self, controllers: Sequence[Controller]) -> bool:
        """Start controllers, and stop those that hold the same joints; False if that fails."""
        ...
