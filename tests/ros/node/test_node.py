"""Nodes among themselves: topics, services, parameters, logs; in one process and over sockets."""

import asyncio
import errno
import io
import queue
import sys
import threading
from types import MappingProxyType
from typing import Any

import numpy as np
import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros import (
    MasterProxy,
    MessageError,
    ParameterError,
    RawMessage,
    ServiceError,
    SimClock,
    Subscription,
    WallClock,
    colored,
    follow_time,
    probe_service,
)
from trundle.ros.transport.tcpros import FrameProtocol
from trundle.ros.transport.unix_sockets import unix_address

STRING = "std_msgs/String"


@pytest.fixture(params=["same process", "Unix socket", "TCP", "TCP without writev", "TCP with too many files"])
def pair(request: pytest.FixtureRequest, graph: Any, far: Any, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, Any]:
    """A publishing and a subscribing node."""
    if request.param.startswith("TCP"):
        monkeypatch.setattr("trundle.ros.node.subscription.unix_address", lambda _: None)
    if "writev" in request.param:
        monkeypatch.delattr("os.writev")
    if "files" in request.param:

        def refuse(_: object) -> None:
            raise OSError(errno.EMFILE, "too many open files")

        monkeypatch.setattr("asyncio.trsock.TransportSocket.dup", refuse)
    return graph.node("talker"), (graph if request.param == "same process" else far).node("listener")


def test_an_answer_that_is_older_than_an_update_drops_no_publisher(
    graph: Any, far: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The master's answer to a registration may arrive after the update of a publisher that came since."""
    talker, listener = graph.node("talker"), far.node("listener")
    publisher = talker.advertise("late", STRING)
    graph.ready(talker)
    call = listener.master.call

    async def answer_late(method: str, *arguments: object) -> Any:
        answer = await call(method, *arguments)
        if method != "registerSubscriber":
            return answer
        listener.endpoints.publishers_changed("/late", answer)
        return []

    monkeypatch.setattr(listener.master, "call", answer_late)
    listener.subscribe("late", STRING, lambda _: None)
    far.ready(listener)
    graph.until(lambda: publisher.has_subscribers)


def test_messages_reach_a_subscriber_in_order(graph: Any, pair: tuple[Any, Any]) -> None:
    talker, listener = pair
    got: list[str] = []
    publisher = talker.advertise("chatter", STRING, queue_size=None)
    listener.subscribe("chatter", STRING, lambda m: got.append(m.data))
    graph.until(lambda: publisher.has_subscribers)
    for i in range(100):
        publisher.publish({"data": str(i)})
    graph.until(lambda: len(got) == 100)
    assert got == [str(i) for i in range(100)]


def test_fields_may_be_any_mapping(graph: Any) -> None:
    talker = graph.node("talker")
    got: list[str] = []
    publisher = talker.advertise("chatter", STRING)
    talker.subscribe("chatter", STRING, lambda m: got.append(m.data))
    graph.until(lambda: publisher.has_subscribers)
    publisher.publish(MappingProxyType({"data": "x"}))
    graph.until(lambda: got == ["x"])


def test_a_subscriber_in_the_same_process_receives_the_published_object(graph: Any) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    got: list[Any] = []
    publisher = talker.advertise("chatter", STRING)
    listener.subscribe("chatter", STRING, got.append)
    graph.until(lambda: publisher.has_subscribers)
    message = talker.new(STRING, {"data": "x"})
    publisher.publish(message)
    graph.loop.flush_deliveries()
    assert got[0] is message
    (link,) = (link for link in talker.endpoints.connections() if link[4] == "/chatter")
    assert link[1:6] == ["/listener", "o", "INTRAPROCESS", "/chatter", True]


def test_a_new_subscriber_gets_the_latched_message(graph: Any, pair: tuple[Any, Any]) -> None:
    talker, listener = pair
    talker.advertise("map", STRING, latch=True).publish({"data": "the map"})
    graph.ready(talker)
    got: list[str] = []
    listener.subscribe("map", STRING, lambda m: got.append(m.data))
    graph.until(lambda: got == ["the map"])


@pytest.mark.parametrize("others", [0, 1])
def test_what_a_new_subscriber_causes_to_be_published_reaches_it(
    graph: Any, far: Any, monkeypatch: pytest.MonkeyPatch, others: int
) -> None:
    """An action's client sends its goal as soon as it is connected; the result must not be lost."""
    publisher = graph.node("talker").advertise("result", STRING)
    for number in range(others):
        far.node(f"other_{number}").subscribe("result", STRING, lambda _: None)
    graph.until(lambda: publisher.subscribers == others)
    send_header = FrameProtocol.send_header
    is_answered = threading.Event()

    def send_and_publish(link: FrameProtocol, fields: dict[str, str]) -> None:
        send_header(link, fields)
        if fields["callerid"] == "/talker":
            server = threading.Thread(target=publisher.publish, args=({"data": "done"},))
            server.start()
            server.join()
            is_answered.set()

    monkeypatch.setattr(FrameProtocol, "send_header", send_and_publish)
    got: list[str] = []
    far.node("client").subscribe("result", STRING, lambda m: got.append(m.data))
    assert is_answered.wait(PATIENCE_S)
    graph.until(lambda: publisher.subscribers == others + 1)
    publisher.publish({"data": "end"})
    graph.until(lambda: got[-1:] == ["end"])
    assert got == ["done", "end"]


def test_header_sequence_numbers_are_filled_in(graph: Any, pair: tuple[Any, Any]) -> None:
    talker, listener = pair
    got: list[int] = []
    publisher = talker.advertise("joints", "sensor_msgs/JointState")
    listener.subscribe("joints", "sensor_msgs/JointState", lambda m: got.append(m.header.seq))
    graph.until(lambda: publisher.has_subscribers)
    for _ in range(3):
        publisher.publish({})
    graph.until(lambda: len(got) == 3)
    assert got == [1, 2, 3]


def test_a_raw_subscription_receives_bytes_and_definition(graph: Any, pair: tuple[Any, Any]) -> None:
    talker, listener = pair
    got: list[RawMessage] = []
    publisher = talker.advertise("chatter", STRING, latch=True)
    listener.subscribe("chatter", "*", got.append)
    publisher.publish({"data": "hi"})
    graph.until(lambda: got)
    assert got[0].data == b"\x02\x00\x00\x00hi"
    assert (got[0].type, got[0].md5sum) == (STRING, "992ce8a1687cec8c8bd883ec73ca41d1")
    assert got[0].definition == "string data\n"


def test_bytes_are_published_unchanged(graph: Any, pair: tuple[Any, Any]) -> None:
    talker, listener = pair
    got: list[str] = []
    talker.advertise("chatter", STRING, latch=True).publish(b"\x02\x00\x00\x00hi")
    listener.subscribe("chatter", STRING, lambda m: got.append(m.data))
    graph.until(lambda: got == ["hi"])


def test_long_messages_arrive_complete_and_in_order(graph: Any, pair: tuple[Any, Any]) -> None:
    """Longer than the kernel buffers, so that they are sent in many parts; a field follows the array."""
    talker, listener = pair
    kind, count = "sensor_msgs/PointCloud2", 12
    got: list[Any] = []
    publisher = talker.advertise("cloud", kind, queue_size=None)
    listener.subscribe("cloud", kind, got.append)
    graph.until(lambda: publisher.has_subscribers)
    for i in range(count):
        points = np.arange(1_000_003 + i, dtype=np.uint8)
        publisher.publish(talker.new(kind, {"width": i, "data": points, "is_dense": bool(i % 2)}))
    graph.until(lambda: len(got) == count)
    assert [(m.header.seq, m.width, m.is_dense) for m in got] == [(i + 1, i, bool(i % 2)) for i in range(count)]
    assert all(np.array_equal(m.data, np.arange(1_000_003 + i, dtype=np.uint8)) for i, m in enumerate(got))


def test_a_type_mismatch_is_refused_and_logged(graph: Any, pair: tuple[Any, Any], capfd: Any) -> None:
    talker, listener = pair
    publisher = talker.advertise("chatter", STRING)
    listener.subscribe("chatter", "std_msgs/Int32", print)
    output: list[str] = []
    graph.until(lambda: output.append(capfd.readouterr().err) or "no messages on /chatter" in "".join(output))
    assert not publisher.has_subscribers


def test_callbacks_may_be_coroutines_and_keep_their_order(graph: Any) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    got: list[str] = []

    async def slow(message: Any) -> None:
        await asyncio.sleep(0.002 if message.data == "0" else 0)
        got.append(message.data)

    publisher = talker.advertise("chatter", STRING)
    listener.subscribe("chatter", STRING, slow)
    graph.until(lambda: publisher.has_subscribers)
    for i in range(5):
        publisher.publish({"data": str(i)})
    graph.until(lambda: len(got) == 5)
    assert got == ["0", "1", "2", "3", "4"]


def test_a_failing_callback_is_logged_and_the_next_message_delivered(graph: Any, capfd: Any) -> None:
    talker, listener = graph.node("talker"), graph.node("listener")
    got: list[str] = []

    def callback(message: Any) -> None:
        got.append(message.data)
        if message.data == "bad":
            raise ValueError("cannot take this")

    publisher = talker.advertise("chatter", STRING)
    listener.subscribe("chatter", STRING, callback)
    graph.until(lambda: publisher.has_subscribers)
    publisher.publish({"data": "bad"})
    publisher.publish({"data": "good"})
    graph.until(lambda: len(got) == 2)
    assert "[ERROR]" in (output := capfd.readouterr().err)
    assert "the callback of /chatter failed: cannot take this" in output


def test_a_full_queue_for_another_thread_drops_the_oldest_messages(graph: Any) -> None:
    inbox: queue.Queue[Any] = queue.Queue()
    talker, listener = graph.node("talker"), graph.node("listener", deliver=inbox.put)
    got: list[tuple[str, str]] = []
    publisher = talker.advertise("chatter", STRING, queue_size=None)
    subscription = listener.subscribe(
        "chatter", STRING, lambda m: got.append((m.data, threading.current_thread().name)), queue_size=2
    )
    graph.until(lambda: publisher.has_subscribers)
    for i in range(5):
        publisher.publish({"data": str(i)})
    graph.loop.flush_deliveries()
    assert inbox.qsize() == 2
    while not inbox.empty():
        inbox.get()()
    assert got == [("3", "MainThread"), ("4", "MainThread")]
    assert subscription.dropped == 3


def test_a_service_call_returns_the_response_or_raises_its_error(graph: Any, pair: tuple[Any, Any]) -> None:
    provider, client = pair

    async def handler(request: Any) -> dict[str, Any]:
        if not request.data:
            raise ServiceError("only true")
        return {"success": True, "message": "done"}

    provider.advertise_service("~enable", "std_srvs/SetBool", handler)
    graph.ready(provider)
    run = client.loop.run
    assert run(client.call_service("/talker/enable", "std_srvs/SetBool", {"data": True})).message == "done"
    with pytest.raises(ServiceError, match="only true"):
        run(client.call_service("/talker/enable", "std_srvs/SetBool"))
    with pytest.raises(ServiceError, match=r"refuses: request from .* md5sums do not match"):
        run(client.call_service("/talker/enable", "std_srvs/Trigger"))
    with pytest.raises(ServiceError, match="no node provides the service /nothing"):
        run(client.call_service("/nothing", "std_srvs/Trigger"))
    uri = MasterProxy(graph.core.uri).call("lookupService", "/talker/enable")
    assert run(probe_service(uri, "/talker/enable", "/me"))["type"] == "std_srvs/SetBool"


def test_a_request_can_be_handled_in_another_thread(graph: Any) -> None:
    inbox: queue.Queue[Any] = queue.Queue()
    provider, client = graph.node("talker", deliver=inbox.put), graph.node("listener")
    provider.advertise_service("/where", "std_srvs/Trigger", lambda _: {"message": threading.current_thread().name})
    graph.ready(provider)
    answer = graph.loop.spawn(client.call_service("/where", "std_srvs/Trigger"))
    inbox.get(timeout=PATIENCE_S)()
    assert answer.result(PATIENCE_S).message == "MainThread"


def test_parameters_are_read_and_written(graph: Any) -> None:
    node = graph.node("n", namespace="/ns", params={"rate": 20})
    graph.ready(node)
    run = graph.loop.run
    assert node.name == "/ns/n"
    assert run(node.params.get("~rate")) == 20
    assert run(node.params.get("nope", 5)) == 5
    with pytest.raises(ParameterError, match="/ns/nope is not set"):
        run(node.params.get("nope"))
    with pytest.raises(ParameterError, match="32 bits"):
        run(node.params.set("big", 2**40))
    run(node.params.set("/robot_description", "<robot/>"))
    assert run(node.params.search("robot_description")) == "/robot_description"
    assert run(node.params.search("nope")) is None
    run(node.params.delete("~rate"))
    assert not run(node.params.has("~rate"))


def test_names_are_remapped(graph: Any) -> None:
    node = graph.node("n", namespace="ns", remappings={"scan": "/front", "~out": "result"})
    assert node.advertise("scan", STRING).topic == "/front"
    assert node.resolve("~out") == "/ns/result"


def test_search_finds_a_parameter_by_its_remapped_name(graph: Any) -> None:
    """As in roscpp and rospy: robot_state_publisher with robot_description:=arm_description reads the arm."""
    node = graph.node("n", namespace="/arm", remappings={"robot_description": "arm_description"})
    graph.ready(node)
    run = graph.loop.run
    run(node.params.set("/robot_description", "<the base/>"))
    run(node.params.set("/arm_description", "<the arm/>"))
    assert run(node.params.search("robot_description")) == "/arm_description"


def test_log_messages_reach_stderr_and_rosout_agg(graph: Any, far: Any, capfd: Any) -> None:
    node, reader = graph.node("warner"), far.node("reader")
    got: list[Any] = []
    reader.subscribe("/rosout_agg", "rosgraph_msgs/Log", got.append)
    graph.ready(node)

    def is_aggregated() -> bool:
        node.log.warn("careful")
        return any(m.name == "/warner" for m in got)

    graph.until(is_aggregated)
    log = next(m for m in got if m.name == "/warner")
    assert (log.level, log.msg, log.file, log.topics) == (4, "careful", "test_node.py", ["/rosout"])
    assert "[WARN] [" in capfd.readouterr().err
    graph.loop.run(node.call_service("~set_logger_level", "roscpp/SetLoggerLevel", {"level": "error"}))
    node.log.warn("filtered")
    assert "filtered" not in capfd.readouterr().err
    loggers = graph.loop.run(node.call_service("~get_loggers", "roscpp/GetLoggers")).loggers
    levels = {logger.name: logger.level for logger in loggers}
    assert (levels["rosout"], levels["rospy.topics"]) == ("error", "info")


def test_only_a_terminal_without_no_color_gets_colors(monkeypatch: pytest.MonkeyPatch) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    monkeypatch.delenv("NO_COLOR", raising=False)
    assert colored("hot", "error", Terminal()) == "\033[31mhot\033[0m"
    assert colored("hot", "info", Terminal()) == "hot"
    assert colored("hot", "error", io.StringIO()) == "hot"
    monkeypatch.setenv("NO_COLOR", "1")
    assert colored("hot", "error", Terminal()) == "hot"


def test_unregistered_endpoints_leave_the_master(graph: Any) -> None:
    node, other = graph.node("n"), graph.node("other")
    publisher = node.advertise("a", STRING)
    subscription = other.subscribe("a", STRING, print)
    service = node.advertise_service("s", "std_srvs/Empty", lambda _: {})
    graph.until(lambda: publisher.has_subscribers)
    for endpoint in (publisher, subscription, service):
        endpoint.unregister()
    graph.ready(node, other)
    state = MasterProxy(graph.core.uri).call("getSystemState")
    assert not [name for table in state for name, _ in table if name in ("/a", "/s")]


def test_shutdown_leaves_no_registration_at_the_master(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("a", STRING)
    node.subscribe("b", STRING, print)
    graph.ready(node)
    graph.loop.run(node.shutdown())
    state = MasterProxy(graph.core.uri).call("getSystemState")
    assert not [name for table in state for name, nodes in table if "/n" in nodes]
    assert node.is_shut_down


def test_endpoints_unregistered_just_before_shutdown_leave_the_master(graph: Any) -> None:
    node = graph.node("n")
    endpoints = [node.advertise("a", STRING), node.subscribe("b", STRING, print)]
    endpoints.append(node.advertise_service("s", "std_srvs/Empty", lambda _: {}))
    graph.ready(node)

    async def end() -> None:
        for endpoint in endpoints:
            endpoint.unregister()
        await node.shutdown()

    graph.loop.run(end())
    state = MasterProxy(graph.core.uri).call("getSystemState")
    assert not [name for table in state for name, nodes in table if "/n" in nodes]


def test_a_second_node_of_the_same_name_shuts_down_the_first(graph: Any, far: Any) -> None:
    first = graph.node("twin")
    first.advertise("a", STRING)
    graph.ready(first)
    reasons: list[str] = []
    first.on_shutdown(reasons.append)
    far.ready(far.node("twin"))
    graph.until(lambda: first.is_shut_down)
    assert reasons == ["[/twin] Reason: new node registered with same name"]


def test_a_topic_has_one_type_in_a_node(graph: Any) -> None:
    node = graph.node("n")
    publisher = node.advertise("a", STRING)
    assert node.advertise("a", STRING) is publisher
    with pytest.raises(MessageError, match="publishes /a as std_msgs/String"):
        node.advertise("a", "std_msgs/Int32")
    with pytest.raises(MessageError, match="no message type"):
        node.subscribe("b", "std_msgs/Nope", print)


def test_publishing_without_subscribers_does_nothing(graph: Any) -> None:
    publisher = graph.node("n").advertise("a", STRING)
    publisher.publish({"nonsense": 1})
    assert publisher.published == 0


def test_ros_time_is_wall_time_unless_use_sim_time_is_set(graph: Any, far: Any) -> None:
    node = far.node("n")
    assert isinstance(far.loop.run(follow_time(node)), WallClock)
    far.loop.run(node.params.set("/use_sim_time", True))
    clock = far.loop.run(follow_time(node))
    assert isinstance(clock, SimClock)
    assert clock.now_ns() == 0
    ticker = graph.node("sim").advertise("/clock", "rosgraph_msgs/Clock", latch=True)
    ticker.publish({"clock": {"secs": 3, "nsecs": 7}})
    graph.until(lambda: clock.now_ns() == 3_000_000_007)
    assert node.stamp().nanosec == 7


def test_a_node_registers_at_a_master_that_starts_later(graph: Any, capfd: Any) -> None:
    from trundle.ros import Core, Node

    port = graph.core.port
    graph.loop.run(graph.core.stop())
    node = Node("early", loop=graph.loop, master_uri=f"http://127.0.0.1:{port}")
    node.advertise("a", STRING)
    output: list[str] = []
    graph.until(lambda: output.append(capfd.readouterr().err) or "keeps trying" in "".join(output))
    graph.core = Core(graph.loop, port=port)
    graph.loop.run(graph.core.start())
    graph.ready(node)
    assert MasterProxy(graph.core.uri).call("lookupNode", "/early") == node.uri


def test_changes_of_a_watched_parameter_call_back(graph: Any) -> None:
    watcher, other = graph.node("watcher", namespace="/r"), graph.node("other")
    graph.ready(watcher, other)
    changes: list[tuple[str, Any]] = []
    graph.loop.run(other.params.set("/r/gains", {"p": 1.0}))
    now = graph.loop.run(watcher.params.watch("gains", lambda name, value: changes.append((name, value))))
    assert now == {"p": 1.0}
    graph.loop.run(other.params.set("/r/gains/p", 2.0))
    graph.until(lambda: changes == [("/r/gains/p", 2.0)])
    graph.loop.run(other.params.set("/r/unwatched", 3))
    graph.loop.run(other.params.delete("/r/gains"))
    graph.until(lambda: len(changes) == 2)
    assert changes[1] == ("/r/gains", {})
    graph.loop.run(watcher.shutdown())
    graph.loop.run(other.params.set("/r/gains", {"p": 5.0}))
    assert len(changes) == 2


def test_a_parameter_can_be_watched_before_the_node_listens(graph: Any) -> None:
    """The master needs the node's address, which is not known at once."""
    for i in range(10):
        assert graph.loop.run(graph.node(f"n{i}").params.watch("unset", lambda *_: None)) == {}


def test_private_parameters_are_set_before_the_first_read(graph: Any) -> None:
    """Even if the read is the node's first call."""
    nodes = [graph.node(f"n{i}", params={"rate": i, "mode": "fast"}) for i in range(10)]
    assert [graph.loop.run(node.params.get("~rate", None)) for node in nodes] == list(range(10))
    assert graph.loop.run(graph.node("other", params={"x": 1}).params.has("~x"))


def test_nodes_of_one_machine_connect_over_unix_sockets(graph: Any, far: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    if not sys.platform.startswith("linux"):
        pytest.skip("sockets without files exist on Linux only")
    talker = graph.node("talker")
    talker.advertise("/a", "std_msgs/String", latch=True).publish({"data": "hello"})
    graph.ready(talker)
    got: list[str] = []
    for name, offered in (
        ("near", unix_address),
        ("stranger", lambda _: "\0trundle-gone"),
        ("plain", lambda _: None),
    ):
        monkeypatch.setattr("trundle.ros.node.subscription.unix_address", offered)
        far.node(name).subscribe("/a", "std_msgs/String", lambda m: got.append(m.data))
        graph.until(lambda name=name: any(link[1] == f"/{name}" for link in talker.endpoints.connections()))
    graph.until(lambda: got == ["hello"] * 3)
    kinds = {peer: kind for _, peer, _, kind, topic, *_ in talker.endpoints.connections() if topic == "/a"}
    assert kinds == {"/near": "UNIXROS", "/stranger": "TCPROS", "/plain": "TCPROS"}


def test_messages_published_from_another_thread_keep_their_order(graph: Any, far: Any) -> None:
    """A message is sent at once if none waits, else in turn; new and slow subscribers make messages wait."""
    publisher = graph.node("talker").advertise("/a", "std_msgs/UInt8MultiArray", queue_size=None)
    got: list[int] = []
    far.node("reader").subscribe(
        "/a", "std_msgs/UInt8MultiArray", lambda m: got.append(int.from_bytes(bytes(m.data[:4]))), queue_size=None
    )
    graph.until(lambda: publisher.subscribers == 1)
    near: Subscription | None = None
    for i in range(600):
        if i == 200:
            near = graph.node("near").subscribe("/a", "std_msgs/UInt8MultiArray", lambda _: None)
            graph.until(lambda: publisher.subscribers == 2)
        if i == 400:
            assert near is not None
            near.unregister()
        publisher.publish({"data": i.to_bytes(4) + bytes(200_000 if i % 3 else 5)})
    graph.until(lambda: len(got) >= 600)
    assert got == list(range(600))


def test_a_response_longer_than_the_kernel_buffers_arrives_complete(graph: Any, far: Any) -> None:
    text = "x" * 20_000_000
    provider = graph.node("talker")
    provider.advertise_service("/long", "std_srvs/Trigger", lambda _: {"message": text})
    graph.ready(provider)
    assert far.loop.run(far.node("asker").call_service("/long", "std_srvs/Trigger"), PATIENCE_S).message == text
