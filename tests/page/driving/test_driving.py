"""The dead man's switch: however driving ends, the robot gets one zero."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph, until
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.page.clients.protocol import TRUNDLE, TRUNDLE_DRIVE as DRIVE
from trundle.ros import Node


class Robot:
    """Subscriber to velocities, with their times of arrival."""

    def __init__(self, node: Node, topic: str, type_name: str = "geometry_msgs/Twist") -> None:
        self.received: list[tuple[float, float, float]] = []
        self._is_stamped = type_name.endswith("Stamped")
        node.subscribe(topic, type_name, self._receive)

    def _receive(self, message: Any) -> None:
        twist = message.twist if self._is_stamped else message
        self.received.append((time.monotonic(), twist.linear.x, twist.angular.z))

    @property
    def velocities(self) -> list[tuple[float, float]]:
        return [(linear, angular) for _, linear, angular in self.received]


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture
def drive_page(graph: Graph) -> Iterator[PageServer]:
    address = GraphAddress(master_uri=graph.core.uri)
    node = graph.node("owner")
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address, node=node) as page:
        yield page
    graph.loop.run(node.shutdown())


@pytest.fixture
def robot(graph: Graph, request: pytest.FixtureRequest) -> Iterator[Robot]:
    node = graph.node("robot")
    yield Robot(node, "/cmd_vel")
    graph.loop.run(node.shutdown())


def _drive(
    client: ProtocolClient, robot: Robot, velocity: tuple[float, float] = (0.5, -0.25), *, lease: float = 0.3
) -> float:
    """Drive until the robot has received the velocity; return the time of the last command."""
    before, sent = len(robot.received), [0.0]

    def command() -> bool:
        sent[0] = time.monotonic()
        client.send("trundle/drive", topic="/cmd_vel", linear=velocity[0], angular=velocity[1], lease=lease)
        return velocity in robot.velocities[before:]

    client.until(command)
    return sent[0]


def _until_stopped(robot: Robot) -> float:
    """Return the time of the first zero."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        if (0.0, 0.0) in robot.velocities:
            return next(stamp for stamp, linear, angular in robot.received if (linear, angular) == (0.0, 0.0))
        time.sleep(0.002)
    raise AssertionError("no zero came")


def _assert_one_stop(robot: Robot) -> None:
    """Assert that the robot got one zero, and nothing after it."""
    _until_stopped(robot)
    time.sleep(0.5)
    assert robot.velocities.count((0.0, 0.0)) == 1
    assert robot.velocities[-1] == (0.0, 0.0)


def test_commands_arrive_and_release_stops(drive_page: PageServer, robot: Robot) -> None:
    with ProtocolClient(drive_page.url) as client:
        _drive(client, robot)
        client.send("trundle/release", topic="/cmd_vel")
        client.send("trundle/release", topic="/cmd_vel")
        _assert_one_stop(robot)


def test_silence_stops(drive_page: PageServer, robot: Robot) -> None:
    with ProtocolClient(drive_page.url) as client:
        last = _drive(client, robot)
        stopped = _until_stopped(robot)
        assert stopped - last >= 0.3  # not before the lease's end
        _assert_one_stop(robot)


def test_a_velocity_is_repeated_for_its_lease(drive_page: PageServer, robot: Robot) -> None:
    """A client that is held up for less than its lease does not stop the robot."""
    with ProtocolClient(drive_page.url, protocol=DRIVE) as client:
        _drive(client, robot)
        robot.received.clear()
        sent = time.monotonic()
        client.send("trundle/drive", topic="/cmd_vel", linear=0.5, angular=-0.25, lease=1.0, number=7)
        client.until(lambda: {"op": "trundle/driven", "number": 7} in client.jsons)
        stopped = _until_stopped(robot)
        print(f"{len(robot.received) - 1} velocities in {stopped - sent:.2f} s")
        assert stopped - sent > 0.95
        assert robot.velocities.count((0.5, -0.25)) > 2
        _assert_one_stop(robot)


def test_a_driving_socket_only_drives(drive_page: PageServer) -> None:
    with ProtocolClient(drive_page.url, protocol=DRIVE) as client:
        client.send("subscribe", subscriptions=[{"id": 1, "channelId": 1}])
        client.until(lambda: client.statuses)
        client.socket.send(b"\x01\0\0\0\0")
        client.until(lambda: len(client.statuses) == 2)
        assert {status["message"] for status in client.statuses} == {"a socket of trundle.drive.v1 only drives"}
        assert (client.channels, client.services, client.times) == ({}, {}, [])


def test_a_view_only_link_does_not_drive(drive_page: PageServer, robot: Robot) -> None:
    with ProtocolClient(drive_page.view_url, protocol=DRIVE) as viewer, ProtocolClient(drive_page.url) as driver:
        for _ in range(5):
            viewer.send("trundle/drive", topic="/cmd_vel", linear=2.0, angular=0.0)
            _drive(driver, robot)
        viewer.until(lambda: len(viewer.statuses) >= 5)
        assert {status["message"] for status in viewer.statuses} == {"this link is view-only"}
        assert (2.0, 0.0) not in robot.velocities


@pytest.mark.parametrize("protocol", [TRUNDLE, DRIVE])
def test_a_closed_socket_stops(drive_page: PageServer, robot: Robot, protocol: str) -> None:
    with ProtocolClient(drive_page.url, protocol=protocol) as client:
        _drive(client, robot)
        client.socket.socket.shutdown(2)
        _assert_one_stop(robot)


def test_a_leaving_client_that_did_not_drive_sends_no_zero(drive_page: PageServer, robot: Robot) -> None:
    with ProtocolClient(drive_page.url) as driver, ProtocolClient(drive_page.url) as other:
        _drive(driver, robot, lease=1.0)
        other.send("trundle/release", topic="/cmd_vel")
        _drive(driver, robot, lease=1.0)
        other.socket.socket.shutdown(2)  # a farewell would take longer than a lease on a busy machine
        for _ in range(5):
            _drive(driver, robot, lease=1.0)
        assert (0.0, 0.0) not in robot.velocities


def test_the_robot_stops_when_its_last_driver_ends(drive_page: PageServer, robot: Robot) -> None:
    with ProtocolClient(drive_page.url) as one, ProtocolClient(drive_page.url) as two:
        _drive(one, robot, lease=1.0)
        _drive(two, robot, (0.1, 0.0), lease=1.0)
        one.send("trundle/release", topic="/cmd_vel")
        _drive(two, robot, (0.2, 0.0), lease=1.0)
        assert (0.0, 0.0) not in robot.velocities
        two.send("trundle/release", topic="/cmd_vel")
        _assert_one_stop(robot)


def _kill(page: PageServer) -> None:
    os.kill(page.process_id, signal.SIGKILL)


def _suspend(page: PageServer) -> None:
    os.kill(page.process_id, signal.SIGSTOP)


_ENDS = {"killed": _kill, "suspended": _suspend, "closed": PageServer.close}


@pytest.mark.parametrize("how", _ENDS)
def test_the_end_of_the_server_stops(drive_page: PageServer, robot: Robot, how: str) -> None:
    with ProtocolClient(drive_page.url) as client:
        _drive(client, robot)
        ended = time.monotonic()
        ending = threading.Thread(target=_ENDS[how], args=(drive_page,))
        ending.start()
        stopped = _until_stopped(robot)
        ending.join()

    print(f"stopped after {stopped - ended:.2f} s")
    assert robot.velocities[-1] == (0.0, 0.0)


def test_a_resumed_server_is_watched_again(drive_page: PageServer, robot: Robot) -> None:
    with ProtocolClient(drive_page.url) as client:
        for _ in range(2):
            _drive(client, robot)
            os.kill(drive_page.process_id, signal.SIGSTOP)
            until(lambda: robot.velocities[-1] == (0.0, 0.0))
            os.kill(drive_page.process_id, signal.SIGCONT)


def test_stamped_twists_are_published_on_topics_of_that_type(graph: Graph, drive_page: PageServer) -> None:
    node = graph.node("stamped_robot")
    robot = Robot(node, "/stamped", "geometry_msgs/TwistStamped")
    graph.ready(node)
    with ProtocolClient(drive_page.url) as client:

        def command() -> bool:
            client.send("trundle/drive", topic="/stamped", linear=1.0, angular=0.0)
            return (1.0, 0.0) in robot.velocities

        client.until(command)
    _until_stopped(robot)
    graph.loop.run(node.shutdown())


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"topic": "/chatter"}, "its type is std_msgs/String"),
        ({"topic": "no name"}, "cannot be driven"),
        ({"linear": "fast"}, "cannot be read"),
    ],
)
def test_invalid_topics_and_velocities_are_refused(
    graph: Graph, drive_page: PageServer, fields: dict[str, object], reason: str
) -> None:
    node = graph.node("chatter")
    node.advertise("/chatter", "std_msgs/String")
    graph.ready(node)
    with ProtocolClient(drive_page.url) as client:
        client.until(lambda: "/chatter" in client.channels)
        client.send("trundle/drive", **{"topic": "/cmd_vel", "linear": 1.0, "angular": 0.0} | fields)
        client.until(lambda: client.statuses)
        assert reason in client.statuses[0]["message"]
    graph.loop.run(node.shutdown())


def test_driving_without_a_graph_is_refused() -> None:
    with (
        PageServer.start(Session(title="t", kind="log"), at=PageAddress(port=0)) as page,
        ProtocolClient(page.url) as client,
    ):
        client.send("trundle/drive", topic="/cmd_vel", linear=1.0, angular=0.0)
        client.until(lambda: client.statuses)
        assert client.statuses[0]["message"] == "this page has no ROS graph"
