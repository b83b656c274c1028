"""Fakes: a node without a graph, on a clock that the test sets, and a page."""

import asyncio
from collections.abc import Callable, Coroutine, Sequence
from typing import Any

from trundle.gazebo.nodes import Slider
from trundle.ros import DISTROS, LEVELS, Message, Messages, Node

MESSAGES = Messages()


class FakeClock:
    """Clock that advances only while a node sleeps, to its exact wake-up time plus the delay that a test adds."""

    def __init__(self, *, start_ns: int = 1_000_000_000, end_ns: int, late_ns: Callable[[], int] = lambda: 0) -> None:
        self.ns = start_ns
        self._end_ns = end_ns
        self._late_ns = late_ns

    def now_ns(self) -> int:
        return self.ns

    async def sleep_until(self, ns: int) -> None:
        if ns > self._end_ns:
            raise asyncio.CancelledError
        self.ns = max(self.ns, ns) + self._late_ns()
        await asyncio.sleep(0)

    async def sleep(self, seconds: float) -> None:
        await self.sleep_until(self.ns + round(seconds * 1e9))


class FakePublisher:
    """Publisher that keeps its messages."""

    has_subscribers = True

    def __init__(self, type_name: str) -> None:
        self.type = type_name
        self.sent: list[Message] = []

    def publish(self, message: Message | dict[str, Any]) -> None:
        self.sent.append(MESSAGES.new(self.type, message) if isinstance(message, dict) else message)


class FakeLog:
    """Log that keeps messages with their levels."""

    def __init__(self) -> None:
        self.logged: list[tuple[str, str]] = []

    def __getattr__(self, level: str) -> Callable[[str], None]:
        if level not in LEVELS:
            raise AttributeError(level)
        return lambda text: self.logged.append((level, text))


class FakeParams:
    """Parameters by name: private ones without, others with a leading slash."""

    def __init__(self, values: dict[str, Any]) -> None:
        self._values = values

    async def get(self, name: str, default: Any = None) -> Any:
        if name == "~":
            return {key: value for key, value in self._values.items() if not key.startswith("/")}
        key = name[1:] if name.startswith("~") else f"/{name.lstrip('/')}"
        return self._values.get(key, default)

    async def search(self, name: str) -> str | None:
        return f"/{name}" if f"/{name}" in self._values else None


class FakeNode:
    """Fake node without a graph."""

    def __init__(
        self, clock: FakeClock, params: dict[str, Any] | None = None, name: str = "/n", *, distro: str = "noetic"
    ) -> None:
        self.name = name
        self.profile = DISTROS[distro]
        self.clock = clock
        self.messages = MESSAGES
        self.params = FakeParams(params or {})
        self.topics: dict[str, FakePublisher] = {}
        self.callbacks: dict[str, Callable[[Message], object]] = {}
        self.services: dict[str, Callable[[Message], dict[str, Any]]] = {}
        self.log = FakeLog()
        self.closed = asyncio.Event()

    def resolve(self, name: str) -> str:
        return f"{self.name}/{name[1:]}" if name.startswith("~") else f"/{name.lstrip('/')}"

    def advertise(self, topic: str, type_name: str, **_: Any) -> FakePublisher:
        return self.topics.setdefault(self.resolve(topic), FakePublisher(type_name))

    def subscribe(self, topic: str, type_name: str, callback: Callable[[Message], object], **_: Any) -> None:
        assert MESSAGES.has(type_name)
        self.callbacks[self.resolve(topic)] = callback

    def advertise_service(self, name: str, type_name: str, handler: Callable[[Message], dict[str, Any]]) -> None:
        MESSAGES.service(type_name)
        self.services[self.resolve(name)] = handler

    def new(self, type_name: str, fields: object = None) -> Message:
        return MESSAGES.new(type_name, fields, now_ns=self.clock.now_ns())

    def receive(self, topic: str, fields: dict[str, Any], type_name: str) -> None:
        """Have the node receive a message."""
        self.callbacks[topic](MESSAGES.new(type_name, fields))

    def sent(self, topic: str) -> list[Message]:
        """Messages that the node has published on a topic."""
        return self.topics[topic].sent


class FakeDisplay:
    """Fake page that records a node's requests."""

    def __init__(self) -> None:
        self.sliders: Sequence[Slider] = ()
        self.slider_callbacks: list[Callable[[str, float], None]] = []
        self.driven: list[str] = []
        self.images: list[str] = []
        self.panels: list[str] = []
        self.plots: list[Sequence[str]] = []
        self.joystick_callbacks: list[Callable[[Sequence[float], Sequence[int]], None]] = []
        self.shown = 0

    def offer_sliders(self, sliders: Sequence[Slider], move: Callable[[str, float], None]) -> None:
        self.sliders = sliders
        self.slider_callbacks.append(move)

    def drive_on(self, topic: str) -> None:
        self.driven.append(topic)

    def show_image(self, topic: str) -> None:
        self.images.append(topic)

    def open_panel(self, program: str) -> None:
        self.panels.append(program)

    def plot(self, fields: Sequence[str]) -> None:
        self.plots.append(fields)

    def offer_joystick(self, move: Callable[[Sequence[float], Sequence[int]], None]) -> None:
        self.joystick_callbacks.append(move)

    async def show(self, node: Node, *, config: str | None, fixed_frame: str | None) -> int:
        assert config is fixed_frame is None
        self.shown += 1
        await node.closed.wait()
        return 0


def run_to_end(coroutine: Coroutine[Any, Any, int]) -> int | None:
    """Run a node until its clock ends (None) or it ends itself (its exit code)."""

    async def run() -> int | None:
        task = asyncio.ensure_future(coroutine)
        await asyncio.wait([task], timeout=60.0)
        assert task.done()
        return None if task.cancelled() else task.result()

    return asyncio.run(run())
