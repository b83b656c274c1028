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
        self.ends = Expiries()
        self._added_to: dict[int, Wrench] = {}
        """Link → its lasting wrench, below what was added for the coming step."""
        self._grips: dict[int, LinkGrip] = {}

    def clear(self) -> None:
        """Nothing pushes any more; grips stay."""
        self.ends = Expiries()
        self._added_to.clear()

    def restore(self, ends: Expiries) -> None:
        """Go on as it was when these were kept."""
        self.ends = ends.copy()
        self._added_to.clear()

    def shift(self, steps: int) -> None:
        """Let everything end so many steps later: time was set."""
        self.ends = Expiries(
            {link: end + steps for link, end in self.ends.wrenches.items()},
            {axis: end + steps for axis, end in self.ends.efforts.items()},
        )

    def retime(self, before: StepClock, after: StepClock) -> None:
        """Let everything end when it would have, at other steps."""
        self.ends = Expiries(
            {link: after.step_at(before.time_ns(end)) for link, end in self.ends.wrenches.items()},
            {axis: after.step_at(before.time_ns(end)) for axis, end in self.ends.efforts.items()},
        )

    def hold_wrench(self, link: int, wrench: Wrench, *, until: int | None) -> None:
        """Hold a wrench up to a step, or for good."""
        self._added_to.pop(link, None)
        self._engine.set_wrench(link, wrench)
        self.ends.wrenches.pop(link, None)
        if until is not None:
            self.ends.wrenches[link] = until

    def add_wrench(self, link: int, wrench: Wrench) -> None:
        """Add to what pushes, for the coming step."""
        now = self._engine.wrench(link)
        self._added_to.setdefault(link, now)
        self._engine.set_wrench(link, now + wrench)

    def hold_effort(self, joint: JointHandle, axis: int, *, until: int | None) -> None:
        """Have an effort that was set end at a step, or never."""
        self.ends.efforts.pop((joint, axis), None)
        if until is not None:
            self.ends.efforts[joint, axis] = until

    def set_grip(self, link: int, grip: "LinkGrip | None") -> None:
        """Have a link's surface move and slip, or hold on as any other."""
        if self._grips.get(link) == grip:
            return
        if grip is None:
            del self._grips[link]
        else:
            self._grips[link] = grip
        self._engine.set_grips(self._grips)

    def next_ends(self) -> Iterator[int]:
        """The steps at which something ends."""
        yield from self.ends.wrenches.values()
        yield from self.ends.efforts.values()

    def end(self, step: int) -> None:
        """Take away what is over at a step, and what was added for it."""
        for link, lasting in self._added_to.items():
            self._engine.set_wrench(link, lasting)
        self._added_to.clear()
        for link in [link for link, end in self.ends.wrenches.items() if end <= step]:
            del self.ends.wrenches[link]
            self._engine.set_wrench(link, Wrench())
        for joint, axis in [key for key, end in self.ends.efforts.items() if end <= step]:
            if joint.is_there:
                joint.set_effort(0.0, axis=axis)
            else:
                del self.ends.efforts[joint, axis]

    def carry_over(self, links: Mapping[int, int], engine: Engine) -> None:
        """Go on in another engine.

        Args:
            links: where each link went; those that went nowhere are missing.
            engine: the other.
        """
        self._engine = engine
        wrenches = {links[link]: end for link, end in self.ends.wrenches.items() if link in links}
        self.ends = Expiries(wrenches, self.ends.efforts)
        self._added_to = {links[link]: wrench for link, wrench in self._added_to.items() if link in links}
        self._grips = {links[link]: grip for link, grip in self._grips.items() if link in links}
        if self._grips:
            self._engine.set_grips(self._grips)
