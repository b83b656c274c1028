"""Order of stops and reports of driving, tested on single parts."""

import asyncio
import ctypes
import threading
import time
from collections.abc import Callable, Iterator
from typing import cast

import msgspec
import pytest
from tests.graphs import Graph, running_graph, until

from trundle.page.clients.connection import Connection
from trundle.page.clients.protocol import Advertise, ClientChannel, Drive
from trundle.page.driving.dead_man_switch import Driving
from trundle.page.driving.stop import DriveStop
from trundle.page.graph.client_publishers import ClientPublishers
from trundle.ros import Node

TOPIC = "/cmd_vel"
TWIST = "geometry_msgs/Twist"
CLIENT = cast("Connection", object())
FORWARD = Drive(topic=TOPIC, linear=0.5, angular=0.0)


class Events:
    """Reports to the owner and velocities at the robot, in order."""

    def __init__(self) -> None:
        self.log: list[object] = []

    def report(self, topics: dict[str, str]) -> None:
        self.log.append(set(topics))

    def subscribe(self, node: Node) -> None:
        node.subscribe(TOPIC, TWIST, lambda twist: self.log.append(twist.linear.x), on_loop=True)


@pytest.fixture(scope="module")
def shared_graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture
def graph(shared_graph: Graph) -> Iterator[Graph]:
    """The graph, without nodes of earlier tests."""
    yield shared_graph
    for node in list(shared_graph.loop.local.members):
        if isinstance(node, Node) and node.name in ("/page", "/robot", "/other"):
            shared_graph.loop.run(node.shutdown())


@pytest.fixture
def page(graph: Graph) -> Node:
    return graph.node("page")


def _call(graph: Graph, function: Callable[[], object]) -> None:
    """Call a function on the loop of the page's server."""

    async def call() -> None:
        function()

    graph.loop.run(call())


def _driven_robot(graph: Graph, page: Node) -> tuple[Driving, Events]:
    """Return a driven robot."""
    events = Events()
    driving = Driving(events.report)
    events.subscribe(graph.node("robot"))

    def drive() -> bool:
        _call(graph, lambda: driving.drive(CLIENT, FORWARD, {}))
        return 0.5 in events.log

    _call(graph, lambda: driving.set_node(page))
    until(drive)
    events.log.clear()
    return driving, events


def test_a_resumed_server_reports_before_it_moves_the_robot(graph: Graph, page: Node) -> None:
    driving, events = _driven_robot(graph, page)

    def resume() -> None:
        time.sleep(0.2)  # blocks the loop: reports are overdue
        driving.drive(CLIENT, msgspec.structs.replace(FORWARD, linear=0.75), {})

    _call(graph, resume)

    until(lambda: 0.75 in events.log)
    assert events.log[events.log.index(0.75) - 1] == {TOPIC}


@pytest.mark.parametrize("is_renewed", [True, False])
def test_a_lease_that_ends_while_the_server_is_held_up_may_be_renewed_after(
    graph: Graph, page: Node, *, is_renewed: bool
) -> None:
    """What a page sent meanwhile waits in its socket; the server reads it after its timers."""
    driving, events = _driven_robot(graph, page)

    def hold_up() -> None:
        driving.drive(CLIENT, FORWARD, {})
        time.sleep(FORWARD.lease + 0.2)
        renewed = msgspec.structs.replace(FORWARD, linear=0.75)
        if is_renewed:
            asyncio.get_running_loop().call_later(0.03, driving.drive, CLIENT, renewed, {})

    _call(graph, hold_up)

    until(lambda: 0.0 in events.log)
    velocities = [entry for entry in events.log if isinstance(entry, float)]
    assert (0.75 in velocities) is is_renewed
    assert velocities.count(0.0) == 1
    assert velocities[-1] == 0.0


def test_a_robot_is_reported_as_driven_until_its_zero_is_sent(graph: Graph, page: Node) -> None:
    driving, events = _driven_robot(graph, page)

    _call(graph, lambda: driving.release(CLIENT, TOPIC))

    until(lambda: set() in events.log)
    assert events.log[-2:] == [0.0, set()]


def test_a_robot_that_connects_after_the_release_is_stopped(graph: Graph, page: Node) -> None:
    """It may have received a command by an earlier connection."""
    events = Events()
    driving = Driving(events.report)
    _call(graph, lambda: driving.set_node(page))
    _call(graph, lambda: driving.drive(CLIENT, FORWARD, {}))
    _call(graph, lambda: driving.release(CLIENT, TOPIC))

    events.subscribe(graph.node("robot"))

    until(lambda: 0.0 in events.log)


def test_a_new_node_stops_driven_robots(graph: Graph, page: Node) -> None:
    """A robot that does not register again at a new master receives only from the old node."""
    driving, events = _driven_robot(graph, page)

    _call(graph, lambda: driving.set_node(graph.node("other")))

    until(lambda: 0.0 in events.log)


def test_a_leaving_client_does_not_end_topics_that_others_drive(graph: Graph, page: Node) -> None:
    driving, _ = _driven_robot(graph, page)
    publishers = ClientPublishers(is_shared=lambda topic: topic in driving.topics)
    channels = tuple(
        ClientChannel(id=number, topic=topic, encoding="ros1", schema_name=TWIST)
        for number, topic in enumerate((TOPIC, "/own"))
    )
    driven = page.advertise(TOPIC, TWIST)

    _call(graph, lambda: publishers.set_node(page))
    _call(graph, lambda: publishers.advertise(CLIENT, Advertise(channels=channels), {}))
    until(lambda: publishers.topics == {TOPIC, "/own"})
    publisher = page.advertise("/own", TWIST)
    _call(graph, lambda: publishers.forget(CLIENT))

    assert page.advertise(TOPIC, TWIST) is driven
    assert page.advertise("/own", TWIST) is not publisher


def test_a_robot_that_connects_long_after_the_servers_end_is_stopped(graph: Graph, page: Node) -> None:
    """On a busy machine, connecting may take seconds."""
    stop = DriveStop(page)
    stop.follow({TOPIC: TWIST})
    stop.end()
    time.sleep(1.1)

    events = Events()
    events.subscribe(graph.node("robot"))

    until(lambda: events.log == [0.0])


def test_robots_are_stopped_again_when_a_silent_server_ends(graph: Graph, page: Node) -> None:
    stop = DriveStop(page)
    events = Events()
    events.subscribe(graph.node("robot"))
    publisher = page.advertise(TOPIC, TWIST)
    until(lambda: publisher.has_subscribers)
    stop.follow({TOPIC: TWIST})
    until(lambda: events.log == [0.0])

    stop.end()

    until(lambda: events.log == [0.0, 0.0])


def test_an_owner_that_was_held_up_does_not_stop_robots(
    graph: Graph, page: Node, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Reports that came meanwhile are handled after; the owner's own silence is not the server's."""
    monkeypatch.setattr("trundle.page.driving.stop.SILENT_TICKS", 4)
    stop = DriveStop(page)
    events = Events()
    events.subscribe(graph.node("robot"))
    publisher = page.advertise(TOPIC, TWIST)
    until(lambda: publisher.has_subscribers)
    ended = threading.Event()

    def report() -> None:
        while not ended.wait(0.05):
            stop.follow({TOPIC: TWIST})

    reports = threading.Thread(target=report)
    reports.start()
    for _ in range(3):
        time.sleep(0.2)
        ctypes.PyDLL(None).usleep(700_000)  # holds the interpreter's lock: no other thread runs
    time.sleep(0.2)
    before = list(events.log)
    ended.set()
    reports.join()

    assert before == []
    until(lambda: events.log == [0.0])  # without reports
    stop.end()
