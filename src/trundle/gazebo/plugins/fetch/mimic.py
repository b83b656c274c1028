"""robot_controllers/ScaledMimicController: a joint at a multiple of another's position."""

from ..ros_control import ControllerContext, InStepController, Interface

_PERIOD_NS = 10_000_000


class ScaledMimic(InStepController):
    """Holds `controlled_joint` at `mimic_scale` (1) times the position of `mimic_joint`."""

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        self._leader = context.joint(settings.text("mimic_joint"), None)
        self._follower = context.joint(settings.text("controlled_joint"), "PositionJointInterface")
        self._scale = settings.number("mimic_scale", 1.0)
        self.claims: dict[Interface | str, list[str]] = {"PositionJointInterface": [self._follower.name]}
        self._next_ns = 0

    def start(self, time_ns: int) -> None:
        """Hold the current position until the next update."""
        self._follower.start()
        self._next_ns = time_ns

    def due_ns(self, time_ns: int) -> float:
        """Return the time of the next command [ns]."""
        del time_ns
        return self._next_ns

    def update(self, time_ns: int, dt: float) -> None:
        """Command the joint."""
        del dt
        self._follower.command = self._scale * self._leader.position
        self._next_ns = time_ns + _PERIOD_NS

    def stop(self) -> None:
        """Stay where it is."""
        self._follower.stop()

    def close(self) -> None:
        """Do nothing: it has no topic."""
