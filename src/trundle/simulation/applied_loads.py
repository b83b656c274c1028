"""What pushes links and joints for a while, and how links grip what they touch."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from msgspec import Struct, field

from trundle.physics import Engine
from trundle.spatial import Wrench

from .joint_handle import JointHandle
from .step_clock import StepClock

if TYPE_CHECKING:  # a world without belts starts without them
    from trundle.physics import LinkGrip


class Expiries(Struct, frozen=True):
    """When what lasts a while is over, by step."""

    wrenches: dict[int, int] = field(default_factory=dict[int, int])
    """By link."""
    efforts: dict[tuple[JointHandle, int], int] = field(default_factory=dict[tuple[JointHandle, int], int])
    """By joint and axis."""

    def copy(self) -> "Expiries":
        """Its own from now on."""
        return Expiries(dict(self.wrenches), dict(self.efforts))


class AppliedLoads:
    """Wrenches, efforts and grips of one simulation."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self.expiries = Expiries()
        self._lasting: dict[int, Wrench] = {}
        """Link → its lasting wrench, below what was added for the coming step."""
        self._surface_motions: dict[int, LinkGrip] = {}

    def clear(self) -> None:
        """Nothing pushes any more; grips stay."""
        self.expiries = Expiries()
        self._lasting.clear()

    def restore(self, ends: Expiries) -> None:
        """Go on as it was when these were kept."""
        self.expiries = ends.copy()
        self._lasting.clear()

    def shift(self, steps: int) -> None:
        """Let everything end so many steps later: time was set."""
        self.expiries = Expiries(
            {link: end + steps for link, end in self.expiries.wrenches.items()},
            {axis: end + steps for axis, end in self.expiries.efforts.items()},
        )

    def retime(self, before: StepClock, after: StepClock) -> None:
        """Let everything end when it would have, at other steps."""
        self.expiries = Expiries(
            {link: after.step_at(before.time_ns(end)) for link, end in self.expiries.wrenches.items()},
            {axis: after.step_at(before.time_ns(end)) for axis, end in self.expiries.efforts.items()},
        )

    def set_wrench(self, link: int, wrench: Wrench, *, until: int | None) -> None:
        """Hold a wrench up to a step, or for good."""
        self._lasting.pop(link, None)
        self._engine.set_wrench(link, wrench)
        self.expiries.wrenches.pop(link, None)
        if until is not None:
            self.expiries.wrenches[link] = until

    def add_wrench(self, link: int, wrench: Wrench) -> None:
        """Add to what pushes, for the coming step."""
        now = self._engine.wrench(link)
        self._lasting.setdefault(link, now)
        self._engine.set_wrench(link, now + wrench)

    def set_effort_expiry(self, joint: JointHandle, axis: int, *, until: int | None) -> None:
        """Have an effort that was set end at a step, or never."""
        self.expiries.efforts.pop((joint, axis), None)
        if until is not None:
            self.expiries.efforts[joint, axis] = until

    def set_surface_motion(self, link: int, motion: "LinkGrip | None") -> None:
        """Have a link's surface move and slip, or hold on as any other."""
        if self._surface_motions.get(link) == motion:
            return
        if motion is None:
            del self._surface_motions[link]
        else:
            self._surface_motions[link] = motion
        self._engine.set_surface_motions(self._surface_motions)

    def expiry_steps(self) -> Iterator[int]:
        """The steps at which something ends."""
        yield from self.expiries.wrenches.values()
        yield from self.expiries.efforts.values()

    def expire(self, step: int) -> None:
        """Take away what is over at a step, and what was added for it."""
        for link, lasting in self._lasting.items():
            self._engine.set_wrench(link, lasting)
        self._lasting.clear()
        for link in [link for link, end in self.expiries.wrenches.items() if end <= step]:
            del self.expiries.wrenches[link]
            self._engine.set_wrench(link, Wrench())
        for joint, axis in [key for key, end in self.expiries.efforts.items() if end <= step]:
            if joint.is_valid:
                joint.command_effort(0.0, axis=axis)
            else:
                del self.expiries.efforts[joint, axis]

    def transfer_to(self, links: Mapping[int, int], engine: Engine) -> None:
        """Go on in another engine.

        Args:
            links: where each link went; those that went nowhere are missing.
            engine: the other.
        """
        self._engine = engine
        wrenches = {links[link]: end for link, end in self.expiries.wrenches.items() if link in links}
        self.expiries = Expiries(wrenches, self.expiries.efforts)
        self._lasting = {links[link]: wrench for link, wrench in self._lasting.items() if link in links}
        self._surface_motions = {links[link]: motion for link, motion in self._surface_motions.items() if link in links}
        if self._surface_motions:
            self._engine.set_surface_motions(self._surface_motions)
