"""Profile: wall times of the parts of a simulation, with counts."""

from typing import Literal, TypeAlias

from msgspec import Struct

Group: TypeAlias = Literal["physics", "cameras", "sensors", "plugins", "ros", "page", "waiting", "other"]


class ProfilePart(Struct, frozen=True, kw_only=True):
    """Wall time of one part."""

    group: Group
    name: str
    wall_s: float


class Profile(Struct, frozen=True, kw_only=True):
    """Wall times of an interval, with counts."""

    wall_s: float
    simulated_s: float
    steps: int
    contacts: int
    """Number of contacts in the last step."""
    bodies: int
    """Number of links of all models."""
    asleep: int
    """Number of resting trees of bodies, which the physics skips."""
    graph_s: float | None
    """Processor time of the graph's thread, which runs in parallel; None: unknown, or without ROS."""
    parts: tuple[ProfilePart, ...]
    """Parts, the most expensive first; their times add up to the interval."""

    @property
    def real_time_factor(self) -> float | None:
        """Ratio of simulated to wall time; None: no time has passed."""
        return self.simulated_s / self.wall_s if self.wall_s > 0 else None

    def __str__(self) -> str:
        head = f"{self.simulated_s:.3f} s simulated in {self.wall_s:.3f} s; ms per simulated second:"
        if self.simulated_s <= 0:
            return head
        rows = [(part.wall_s, part.group, part.name) for part in self.parts]
        if self.graph_s is not None:
            rows.append((self.graph_s, "parallel", "graph's thread"))
        return "\n".join([head, *(f"{1e3 * s / self.simulated_s:10.3f}  {group:8} {name}" for s, group, name in rows)])
