"""Shares of the physics' time, sampled by timing some strides inside MuJoCo."""

from trundle.sim.physics import StepTimer, StepTimes
from trundle.sim.simulation import Simulation

from ..world.profile import ProfilePart

_PERIOD = 31
"""Timing costs 1/15 of a small robot's step, so every n-th stride is timed; a prime, unlike the periods of hooks."""


class PhysicsShares:
    """Times of the timed strides; belongs to the simulation's thread."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._strides = 0
        self._timer: StepTimer | None = None
        """Running timer of the next stride."""
        self._times: list[StepTimes] = []

    def end_stride(self) -> None:
        """Read the timer after a timed stride, and start it before the next one."""
        self.stop()
        if self._strides % _PERIOD == 0:
            self._timer = self._simulation.engine.timer
            self._timer.start()
        self._strides += 1

    def stop(self) -> None:
        """Stop the timer."""
        timer, self._timer = self._timer, None
        if timer is not None:
            self._times.append(timer.stop())

    def parts(self, wall_s: float) -> list[ProfilePart]:
        """Split the wall time of all strides into parts."""
        total = sum(times.total_s for times in self._times)
        if total <= 0.0:
            return [ProfilePart(group="physics", name="Physics", wall_s=wall_s)]
        collision = sum(times.collision_s for times in self._times) / total
        constraints = sum(times.constraints_s for times in self._times) / total
        shares = {
            "Collision detection": collision,
            "Constraint solver": constraints,
            "Dynamics": max(0.0, 1.0 - collision - constraints),
        }
        return [ProfilePart(group="physics", name=name, wall_s=wall_s * share) for name, share in shares.items()]
