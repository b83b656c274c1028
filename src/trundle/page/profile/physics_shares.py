"""Shares of the physics' time, from strides that are timed inside MuJoCo now and then."""

from trundle.sim.physics import StepTimer, StepTimes
from trundle.sim.simulation import Simulation

from ..world.profile import ProfilePart

_PERIOD = 31
"""Strides between two that are timed, which costs 1/15 of a small robot's step; a prime, as hooks have periods too."""


class PhysicsShares:
    """Times of the strides that were timed; belongs to the simulation's thread."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._strides = 0
        self._timer: StepTimer | None = None
        """Timer of the coming stride."""
        self._times: list[StepTimes] = []

    def end_stride(self) -> None:
        """Read the timers after a timed stride, and start them before the next one that is."""
        self.stop()
        if self._strides % _PERIOD == 0:
            self._timer = self._simulation.engine.timer
            self._timer.start()
        self._strides += 1

    def stop(self) -> None:
        """Stop the timers."""
        timer, self._timer = self._timer, None
        if timer is not None:
            self._times.append(timer.stop())

    def parts(self, wall_s: float) -> list[ProfilePart]:
        """Return the parts of a time that all strides took."""
        total = sum(each.total_s for each in self._times)
        if total <= 0.0:
            return [ProfilePart(group="physics", name="Physics", wall_s=wall_s)]
        collision = sum(each.collision_s for each in self._times) / total
        constraints = sum(each.constraints_s for each in self._times) / total
        shares = {
            "Collision detection": collision,
            "Constraint solver": constraints,
            "Dynamics": max(0.0, 1.0 - collision - constraints),
        }
        return [ProfilePart(group="physics", name=name, wall_s=wall_s * share) for name, share in shares.items()]
