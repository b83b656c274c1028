"""A world whose plugins run, and a fake node that replaces the ROS graph."""

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from pathlib import Path
from typing import Any

import trundle
from trundle.gazebo.model_plugins import load_plugins, load_world_plugins
from trundle.ros import NOETIC, Distro, Messages
from trundle.ros.node.endpoint_recorder import EndpointRecorder
from trundle.sim.simulation import Simulation

BODY = "<inertial><mass>{}</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
ARM = (
    f'<link name="base">{BODY.format(1)}</link><joint name="weld" type="fixed"><parent>world</parent>'
    f'<child>base</child></joint><link name="arm">{BODY.format(1)}</link><joint name="hinge" type="revolute">'
    "<parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis></joint>"
)
"""Arm of 0.1 kg·m² on a vertical hinge."""


class _Loop:
    def run(self, coroutine: Coroutine[Any, Any, Any]) -> Any:
        return asyncio.run(coroutine)


class _Params:
    def __init__(self, values: Mapping[str, object]) -> None:
        self._values = values

    async def get(self, name: str, default: Any) -> Any:
        return self._values.get(name, default)


class FakeNode:
    """Fake node that records subscribers, services and published messages."""

    loop = _Loop()

    def __init__(self, params: Mapping[str, object] | None = None, profile: Distro = NOETIC) -> None:
        self.params, self.profile = _Params(params or {}), profile
        self.services: set[str] = set()
        self._types = Messages()
        self.subscribers: dict[str, list[tuple[str, Callable[[Any], None]]]] = {}
        self.published: dict[str, list[Any]] = {}
        self.latched: set[str] = set()
        self.endpoints = EndpointRecorder()

    def subscribe(self, topic: str, kind: str, callback: Callable[[Any], None], **_: Any) -> None:
        self.subscribers.setdefault(topic, []).append((kind, callback))

    def advertise(self, topic: str, kind: str, *, latch: bool = False, **_: Any) -> "_Topic":
        if latch:
            self.latched.add(topic)
        return _Topic(self._types, kind, self.published.setdefault(topic, []))

    def advertise_service(self, name: str, *_: object) -> None:
        self.services.add(name)

    def receive(self, topic: str, **fields: Any) -> None:
        """Deliver a message to the subscribers of a topic."""
        for kind, callback in self.subscribers[topic]:
            callback(self.new(kind, fields))

    def new(self, kind: str, fields: Any) -> Any:
        return self._types.new(kind, fields)


class _Topic:
    has_subscribers = True

    def __init__(self, types: Messages, kind: str, published: list[Any]) -> None:
        self._types, self._kind, self._published = types, kind, published

    def publish(self, message: Any) -> None:
        self._published.append(self._types.new(self._kind, message) if isinstance(message, dict) else message)


def load(
    folder: Path,
    body: str,
    *,
    gravity: str = "0 0 0",
    ground: bool = False,
    other_models: str = "",
    node: FakeNode | None = None,
) -> Simulation:
    """Return a world with the model `m` and other models, with their plugins loaded."""
    plane = "<include><uri>model://ground_plane</uri></include>" if ground else ""
    file = folder / "w.sdf"
    file.write_text(
        f'<sdf version="1.6"><world name="w"><gravity>{gravity}</gravity>{plane}'
        f'<model name="m">{body}</model>{other_models}</world></sdf>'
    )
    sim = trundle.load(str(file))
    make_node: Any = None if node is None else lambda _: node
    load_plugins(sim, make_node, {}, log=lambda _: None)
    load_world_plugins(sim, make_node, {}, log=lambda _: None)
    return sim
