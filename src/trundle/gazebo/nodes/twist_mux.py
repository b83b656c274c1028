"""twist_mux: forwards the velocity command of the highest priority that is neither expired nor locked."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node

from .host import NodeHost

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_KIND = "geometry_msgs/Twist"
_DIAGNOSTICS_S = 1.0
_MAX_PRIORITY = 255


@dataclass(slots=True)
class TopicHandle:
    """An input topic or lock; it masks lower priorities."""

    name: str
    topic: str
    timeout_s: float
    priority: int
    received_ns: int | None = None
    lock: bool = False
    """Last value of a lock."""

    def is_expired(self, now_ns: int) -> bool:
        """True if the last message is older than the timeout or missing; never with a timeout of 0."""
        if self.timeout_s <= 0.0:
            return False
        return self.received_ns is None or now_ns - self.received_ns > self.timeout_s * 1e9

    def is_locked(self, now_ns: int) -> bool:
        """True if the lock masks lower priorities: its value is true, or it expired."""
        return self.lock or self.is_expired(now_ns)


def read_topic_handles(value: object, name: str) -> list[TopicHandle]:
    """Read a list of {name, topic, timeout, priority}.

    Raises:
        ParamError: the value is not such a list.
    """
    if not isinstance(value, list):
        raise ParamError(f"parameter {name} is not a list of topics")
    sources: list[TopicHandle] = []
    for number, item in enumerate(value):
        section = RosParameters(item, f"{name}[{number}]")
        sources.append(
            TopicHandle(
                section.text("name"),
                section.text("topic"),
                section.number("timeout", 0.0),
                min(max(section.integer("priority"), 0), _MAX_PRIORITY),
            )
        )
    return sources


def lock_priority(locks: Sequence[TopicHandle], now_ns: int) -> int:
    """Return the highest priority of the active locks; inputs below it are masked."""
    return max((lock.priority for lock in locks if lock.is_locked(now_ns)), default=0)


def find_active_topic(sources: Sequence[TopicHandle], locks: Sequence[TopicHandle], now_ns: int) -> TopicHandle | None:
    """Return the active input: of those not expired the one of the highest priority, of equal ones the first; never one
    of priority 0.
    """
    min_priority = max(lock_priority(locks, now_ns), 1)
    candidates = [source for source in sources if not source.is_expired(now_ns) and source.priority >= min_priority]
    return max(candidates, key=lambda source: source.priority, default=None)


class TwistMux:
    """Forwards one of its topics to cmd_vel_out."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._sources: list[TopicHandle] = []
        self._locks: list[TopicHandle] = []

    async def run(self) -> int:
        """Mux until cancelled."""
        node = self._node
        try:
            self._sources = read_topic_handles(await node.params.get("~topics", []), f"{node.name}/topics")
            self._locks = read_topic_handles(await node.params.get("~locks", []), f"{node.name}/locks")
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._output = node.advertise("cmd_vel_out", _KIND, queue_size=1)
        for source in self._sources:
            node.subscribe(source.topic, _KIND, lambda message, s=source: self._on_command(s, message), queue_size=1)
        for lock in self._locks:
            node.subscribe(lock.topic, "std_msgs/Bool", lambda message, s=lock: self._on_lock(s, message), queue_size=1)
        for source in (*self._sources, *self._locks):
            node.log.info(f"{source.name}: {source.topic}, timeout {source.timeout_s:g} s, priority {source.priority}")
        diagnostics = node.advertise("/diagnostics", "diagnostic_msgs/DiagnosticArray", queue_size=1)
        while not node.closed.is_set():
            await node.clock.sleep(_DIAGNOSTICS_S)
            now = node.clock.now_ns()
            diagnostics.publish({"header": {"stamp": now}, "status": [self._status(now)]})
        return 0

    def _on_command(self, source: TopicHandle, message: "geometry_msgs.Twist") -> None:
        now = source.received_ns = self._node.clock.now_ns()
        if find_active_topic(self._sources, self._locks, now) is source:
            self._output.publish(message)

    def _on_lock(self, lock: TopicHandle, message: Any) -> None:
        lock.received_ns = self._node.clock.now_ns()
        lock.lock = bool(message.data)

    def _status(self, now_ns: int) -> dict[str, Any]:
        """Diagnostics in diagnostic_updater's wording."""
        masking = lock_priority(self._locks, now_ns)

        def value(kind: str, source: TopicHandle, state: str) -> dict[str, str]:
            listens = f"listening to {source.topic} @ {source.timeout_s:f}s with priority #{source.priority}"
            return {"key": f"{kind} {source.name}", "value": f" {state} ({listens})"}

        values = [
            value("velocity", s, "masked" if s.is_expired(now_ns) or s.priority < masking else "unmasked")
            for s in self._sources
        ]
        values += [value("lock", lock, "locked" if lock.is_locked(now_ns) else "free") for lock in self._locks]
        values.append({"key": "current priority", "value": str(masking)})
        name = f"{self._node.name.lstrip('/')}: Twist mux status"
        return {"name": name, "message": "ok", "hardware_id": "none", "values": values}
