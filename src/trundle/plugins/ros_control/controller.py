"""What a controller of ros_control is."""

import math
from dataclasses import dataclass
from typing import Protocol, Self

from trundle.control import ToolboxPid
from trundle.ros import Node, Publisher, Service, SettingError, Settings, Subscription
from trundle.simulation import ModelHandle

from .hardware import Hardware, JointHardware
from .transmissions import Interface


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    """Where a controller works."""

    name: str
    """Its name, global; its parameters and topics are within."""
    namespace: str
    """Of the robot."""
    node: Node
    settings: Settings
    hardware: Hardware
    model: ModelHandle

    def joint(self, name: str, interface: Interface | None) -> JointHardware:
        """A joint with the interface that a controller needs; None: any.

        Raises:
            SettingError: there is none, with those there are.
        """
        found = self.hardware.get(name)
        there = ", ".join(sorted(j.name for j in self.hardware.values() if interface in (None, j.interface)))
        if found is None or interface not in (None, found.interface):
            wanted = "" if interface is None else f" with {interface}"
            raise SettingError(f"{self.name}: no joint {name!r}{wanted}; there are: {there or 'none'}")
        return found

    def joint_setting(self) -> list[str]:
        """What `joint` or `joints` names.

        Raises:
            SettingError: neither is set.
        """
        names = self.settings.texts("joints") if "joints" in self.settings.names() else [self.settings.text("joint")]
        if not names:
            raise SettingError(f"parameter {self.name}/joints names no joint")
        return names


def read_pid(settings: Settings) -> ToolboxPid:
    """Gains p, i, d, i_clamp (or i_clamp_min and i_clamp_max, whose smaller magnitude counts) and antiwindup.

    Raises:
        SettingError: p is missing, or one is no number.
    """
    clamps = [abs(settings.number(name)) for name in ("i_clamp_min", "i_clamp_max") if name in settings.names()]
    return ToolboxPid(
        p=settings.number("p"),
        i=settings.number("i", 0.0),
        d=settings.number("d", 0.0),
        i_clamp=min(clamps) if clamps else abs(settings.number("i_clamp", 0.0)),
        antiwindup=settings.flag("antiwindup", default=False),
    )


class Controller(Protocol):
    """Made stopped; all is called on the simulation's thread."""

    claims: dict[Interface | str, list[str]]
    """Interface → joints that nobody else may command."""

    @classmethod
    def make(cls, site: Site) -> Self:
        """Read parameters, advertise and subscribe.

        Raises:
            SettingError: a parameter is missing or of no use.
        """
        ...

    def start(self, time_ns: int) -> None:
        """Begin; the joints were read just now."""
        ...

    def update(self, time_ns: int, dt: float) -> None:
        """Read joints, write commands."""
        ...

    def stop(self) -> None:
        """Let go."""
        ...

    def close(self) -> None:
        """Leave the graph."""
        ...


class Ends:
    """What a controller has on the graph, to be taken off again."""

    def __init__(self) -> None:
        self._ends: list[Publisher | Subscription | Service] = []

    def add(self, *ends: Publisher | Subscription | Service) -> None:
        """Remember."""
        self._ends.extend(ends)

    def close(self) -> None:
        """Unregister all."""
        for end in self._ends:
            end.unregister()
        self._ends.clear()


class Cadence:
    """Says when something is due that happens at a rate of simulated time."""

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = round(1e9 / rate_hz)
        self._last_ns = -math.inf

    def restart(self, time_ns: int) -> None:
        """Count from now."""
        self._last_ns = time_ns

    def due(self, time_ns: int) -> bool:
        """Whether a period has passed; if so, the next begins."""
        if time_ns < self._last_ns:  # time was turned back
            self._last_ns = time_ns
        if time_ns < self._last_ns + self._period_ns:
            return False
        self._last_ns = max(self._last_ns + self._period_ns, time_ns - self._period_ns)
        return True
