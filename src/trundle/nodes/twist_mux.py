"""twist_mux: the velocity command of the highest priority that is fresh and not locked."""

from dataclasses import dataclass
from typing import Any

from trundle.ros import Message, Node, SettingError, Settings

from .host import Host

_KIND = "geometry_msgs/Twist"


@dataclass(slots=True)
class Source:
    """A topic of commands, or a lock; the higher its priority the more it masks."""

    name: str
    topic: str
    timeout_s: float
    priority: int
    heard_ns: int | None = None
    closed: bool = False
    """Of a lock: what it last said."""

    def fresh(self, now_ns: int) -> bool:
        """Whether it was heard within its timeout; 0: for ever."""
        if self.heard_ns is None:
            return False
        return self.timeout_s <= 0.0 or now_ns - self.heard_ns < self.timeout_s * 1e9

    def locks(self, now_ns: int) -> bool:
        """Whether it masks what has no higher priority: it says so, or it fell silent."""
        return self.closed or (self.timeout_s > 0.0 and not self.fresh(now_ns))


def read_sources(value: object, what: str) -> list[Source]:
    """Read a list of {name, topic, timeout, priority}.

    Raises:
        SettingError: it is none.
    """
    if not isinstance(value, list):
        raise SettingError(f"parameter {what} is not a list of topics")
    sources: list[Source] = []
    for number, item in enumerate(value):
        section = Settings(item, f"{what}[{number}]")
        sources.append(
            Source(
                section.text("name"),
                section.text("topic"),
                section.number("timeout", 0.0),
                int(section.number("priority")),
            )
        )
    return sources


def allowed(source: Source, sources: list[Source], locks: list[Source], now_ns: int) -> bool:
    """Tell whether a source may drive now: no other that is fresh is above it, and no lock is at or above it."""
    if any(lock.locks(now_ns) and lock.priority >= source.priority for lock in locks):
        return False
    above = [other.priority for other in sources if other.fresh(now_ns)]
    return source.priority >= max(above, default=source.priority)


class TwistMux:
    """Passes on one of its topics as cmd_vel_out."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del arguments, host
        self._node = node
        self._sources: list[Source] = []
        self._locks: list[Source] = []

    async def run(self) -> int:
        """Mux until cancelled."""
        node = self._node
        try:
            self._sources = read_sources(await node.get_param("~topics", []), f"{node.name}/topics")
            self._locks = read_sources(await node.get_param("~locks", []), f"{node.name}/locks")
        except SettingError as error:
            node.log_fatal(str(error))
            return 1
        self._output = node.advertise("cmd_vel_out", _KIND, queue_size=1)
        for source in self._sources:
            node.subscribe(source.topic, _KIND, lambda message, s=source: self._take(s, message), queue_size=1)
        for lock in self._locks:
            node.subscribe(lock.topic, "std_msgs/Bool", lambda message, s=lock: self._hear(s, message), queue_size=1)
        await node.closed.wait()
        return 0

    def _take(self, source: Source, message: Message) -> None:
        now = source.heard_ns = self._node.clock.now_ns()
        if allowed(source, self._sources, self._locks, now):
            self._output.publish(message)

    def _hear(self, lock: Source, message: Any) -> None:
        lock.heard_ns = self._node.clock.now_ns()
        lock.closed = bool(message.data)
