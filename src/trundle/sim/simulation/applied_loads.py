"""Timed wrenches and efforts, and surface motions of links."""

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Protocol

from msgspec import Struct, field

from trundle.sim.physics import Engine
from trundle.spatial import NS_PER_S, Wrench

from .step_clock import StepClock

if TYPE_CHECKING:  # worlds without belts do not import them
    from trundle.sim.physics import LinkGrip


class DrivenJoint(Protocol):
    """Joint driven by a timed effort."""

    @property
    def is_valid(self) -> bool:
        """True while its model exists."""
        ...

    def command_effort(self, effort: float, *, axis: int = 0) -> None:
        """Drive an axis with this effort [N·m or N]."""
        ...


class Expiries(Struct, frozen=True):
    """Steps at which wrenches and efforts end."""

    wrenches: dict[int, int] = field(default_factory=dict[int, int])
    """Link index → step."""
    efforts: dict[tuple[DrivenJoint, int], int] = field(default_factory=dict[tuple[DrivenJoint, int], int])
    """Joint and axis → step."""

    def copy(self) -> "Expiries":
        """Return an independent copy."""
        return Expiries(dict(self.wrenches), dict(self.efforts))


class AppliedLoads:
    """Wrenches, efforts and surface motions of one simulation."""

    def __init__(self, engine: Engine, clock: Callable[[], tuple[int, int]]) -> None:
        """Create without loads; `clock` returns the current step and the step length [ns]."""
        self._engine = engine
        self._clock = clock
        self.expiries = Expiries()
        self._persistent: dict[int, Wrench] = {}
        """Link → its persistent wrench, without the part added for the coming step."""
        self._surface_motions: dict[int, LinkGrip] = {}

    def clear(self) -> None:
        """Clear all loads except surface motions."""
        self.expiries = Expiries()
        self._persistent.clear()

    def restore(self, expiries: Expiries) -> None:
        """Restore saved expiries."""
        self.expiries = expiries.copy()
        self._persistent.clear()

    def shift(self, steps: int) -> None:
        """Shift all expiries by a number of steps, after the time was set."""
        self.expiries = Expiries(
            {link: end + steps for link, end in self.expiries.wrenches.items()},
            {axis: end + steps for axis, end in self.expiries.efforts.items()},
        )

    def retime(self, before: StepClock, after: StepClock) -> None:
        """Convert all expiries to another step length."""
        self.expiries = Expiries(
            {link: after.step_at(before.time_ns(end)) for link, end in self.expiries.wrenches.items()},
            {axis: after.step_at(before.time_ns(end)) for axis, end in self.expiries.efforts.items()},
        )

    def _end(self, duration_s: float) -> int:
        """Return the step at which a load that begins now ends; it lasts at least one step."""
        step, step_ns = self._clock()
        return step + max(1, round(duration_s * NS_PER_S / step_ns))

    def _left_s(self, end: int | None) -> float | None:
        """Return the remaining duration of a load that ends at a step [s]; None: unlimited."""
        step, step_ns = self._clock()
        return None if end is None else (end - step) * step_ns / NS_PER_S

    def wrench_left_s(self, link: int) -> float | None:
        """Return the remaining duration of a link's wrench [s]; None: until the next one."""
        return self._left_s(self.expiries.wrenches.get(link))

    def effort_left_s(self, joint: DrivenJoint, axis: int) -> float | None:
        """Return the remaining duration of an axis' effort [s]; None: until the next command."""
        return self._left_s(self.expiries.efforts.get((joint, axis)))

    def set_wrench(self, link: int, wrench: Wrench, *, duration_s: float | None) -> None:
        """Apply a wrench for a duration [s], or until the next one (None)."""
        self._persistent.pop(link, None)
        self._engine.set_wrench(link, wrench)
        self.expiries.wrenches.pop(link, None)
        if duration_s is not None:
            self.expiries.wrenches[link] = self._end(duration_s)

    def add_wrench(self, link: int, wrench: Wrench) -> None:
        """Add a wrench for the coming step."""
        now = self._engine.wrench(link)
        self._persistent.setdefault(link, now)
        self._engine.set_wrench(link, now + wrench)

    def limit_effort(self, joint: DrivenJoint, axis: int, duration_s: float | None) -> None:
        """End the effort of an axis after a duration [s], or with the next command (None)."""
        self.expiries.efforts.pop((joint, axis), None)
        if duration_s is not None:
            self.expiries.efforts[joint, axis] = self._end(duration_s)

    def set_surface_motion(self, link: int, motion: "LinkGrip | None") -> None:
        """Set a link's surface motion; None restores ordinary contacts."""
        if self._surface_motions.get(link) == motion:
            return
        if motion is None:
            del self._surface_motions[link]
        else:
            self._surface_motions[link] = motion
        self._engine.set_surface_motions(self._surface_motions)

    def expiry_steps(self) -> Iterator[int]:
        """Yield the steps at which a load ends."""
        yield from self.expiries.wrenches.values()
        yield from self.expiries.efforts.values()

    def expire(self, step: int) -> None:
        """Remove the loads that end at a step, and the loads added for it."""
        for link, wrench in self._persistent.items():
            self._engine.set_wrench(link, wrench)
        self._persistent.clear()
        for link in [link for link, end in self.expiries.wrenches.items() if end <= step]:
            del self.expiries.wrenches[link]
            self._engine.set_wrench(link, Wrench())
        for joint, axis in [key for key, end in self.expiries.efforts.items() if end <= step]:
            if joint.is_valid:
                joint.command_effort(0.0, axis=axis)
            else:
                del self.expiries.efforts[joint, axis]

    def transfer_to(self, links: Mapping[int, int], engine: Engine) -> None:
        """Continue in another engine.

        Args:
            links: old → new index of the links that still exist.
            engine: the new engine.
        """
        self._engine = engine
        wrenches = {links[link]: end for link, end in self.expiries.wrenches.items() if link in links}
        self.expiries = Expiries(wrenches, self.expiries.efforts)
        self._persistent = {links[link]: wrench for link, wrench in self._persistent.items() if link in links}
        self._surface_motions = {links[link]: motion for link, motion in self._surface_motions.items() if link in links}
        if self._surface_motions:
            self._engine.set_surface_motions(self._surface_motions)
