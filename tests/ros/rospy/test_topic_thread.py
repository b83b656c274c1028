"""The topic's thread reads the messages of other processes; the loop does while callbacks are slow."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.ros.rospy.programs import environment

_HEAD = """
import os, threading, rospy
from sensor_msgs.msg import Image
from std_msgs.msg import Int32, String

rospy.init_node("tested")
told = rospy.Publisher("told", String, queue_size=None)
while not told.get_num_connections():
    rospy.sleep(0.001)
def tell(*words):
    told.publish(" ".join(map(str, words)))
"""


@contextmanager
def _running(graph: Graph, text: str, folder: Path) -> Iterator[list[str]]:
    """Run a node; yield what it tells."""
    (folder / "tested.py").write_text(_HEAD + text)
    told: list[str] = []
    listener = graph.node("listener")
    listener.subscribe("/told", "std_msgs/String", lambda message: told.append(message.data), queue_size=None)
    env = environment(sys.executable, graph.core.uri, folder)
    with subprocess.Popen([sys.executable, str(folder / "tested.py")], env=env) as program:
        try:
            yield told
        finally:
            program.kill()


_BLOCKED = """
gate = threading.Event()
def wake():
    selector = image.impl.selector
    while not selector.is_waiting:
        rospy.sleep(0.001)
    selector.wake()  # as a message does that the loop reads first
    tell("woken")
def receive(message):
    name = message.header.frame_id
    tell(name)
    if name == "slow":
        rospy.sleep(0.2)
        threading.Thread(target=wake).start()
    if name == "blocked":
        gate.wait()
image = rospy.Subscriber("in", Image, receive, queue_size={size})
def go_on(count):
    while image.impl._subscription.received < count.data:
        rospy.sleep(0.01)
    gate.set()
go = rospy.Subscriber("go", Int32, go_on)
rospy.spin()
"""
_COUNT, _LENGTH = 60, 100_000
"""More images than the shared memory holds."""


@pytest.mark.parametrize(("size", "expected"), [(1, ["59"]), (3, ["57", "58", "59"]), (None, [*map(str, range(60))])])
def test_a_slow_callback_gets_the_newest_messages_next(size: int | None, expected: list[str], tmp_path: Path) -> None:
    with running_graph() as graph, _running(graph, _BLOCKED.format(size=size), tmp_path) as told:
        node = graph.node("tester")
        source = node.advertise("/in", "sensor_msgs/Image", queue_size=None)
        go = node.advertise("/go", "std_msgs/Int32")

        def publish(name: str) -> None:
            source.publish({"header": {"frame_id": name}, "data": bytes(_LENGTH)})

        graph.until(lambda: source.has_subscribers and go.has_subscribers)
        publish("slow")  # from now on, the loop reads
        graph.until(lambda: told == ["slow", "woken"])
        publish("blocked")
        graph.until(lambda: told == ["slow", "woken", "blocked"])
        for number in range(_COUNT):
            publish(str(number))
        go.publish({"data": 2 + _COUNT})
        graph.until(lambda: told[-1] == str(_COUNT - 1))
    assert told == ["slow", "woken", "blocked", *expected]


_ONE_OF_TWO = """
def receive(message):
    tell(message.data)
    if message.data == "unregister":
        subscriber.unregister()
        tell("unregistered")
        rospy.Subscriber("in", String, lambda message: tell("second", message.data))
subscriber = rospy.Subscriber("in", String, receive)
rospy.spin()
"""


def test_a_callback_may_unregister_its_subscriber_and_subscribe_again(tmp_path: Path) -> None:
    with running_graph() as graph, _running(graph, _ONE_OF_TWO, tmp_path) as told:
        source = graph.node("tester").advertise("/in", "std_msgs/String", queue_size=None)
        graph.until(lambda: source.has_subscribers)
        for text in ("first", "unregister"):
            source.publish({"data": text})
        graph.until(lambda: "unregistered" in told)
        while "second last" not in told:
            source.publish({"data": "last"})
            graph.until(lambda: source.has_subscribers)
    assert told[:3] == ["first", "unregister", "unregistered"]
    assert {*told[3:]} == {"second last"}


_FORKED = """
numbers = []
def receive(message):
    numbers.append(message.data)
    if message.data == 0:
        child = os.fork()
        if not child:
            os._exit(len(numbers))
        tell("child", os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    if message.data == 99:
        tell(numbers == [*range(100)])
subscriber = rospy.Subscriber("in", Int32, receive)
rospy.spin()
"""


def test_a_callback_may_fork(tmp_path: Path) -> None:
    with running_graph() as graph, _running(graph, _FORKED, tmp_path) as told:
        source = graph.node("tester").advertise("/in", "std_msgs/Int32", queue_size=None)
        graph.until(lambda: source.has_subscribers)
        for number in range(100):
            source.publish({"data": number})
        graph.until(lambda: len(told) == 2)
    assert told == ["child 1", "True"]


_MANY_TIMES = """
counts = {}
def receive(message):
    thread = threading.current_thread()
    counts[thread] = counts.get(thread, 0) + 1
for number in range(30):
    subscribers = [rospy.Subscriber("in", Int32, receive) for _ in range(2)]
    while len(counts) == number:
        rospy.sleep(0.001)
    for subscriber in subscribers:
        subscriber.unregister()
tell(len(counts), threading.active_count() < 20)
rospy.spin()
"""


def test_subscribing_and_unsubscribing_while_messages_flow_ends_every_thread(tmp_path: Path) -> None:
    with running_graph() as graph, _running(graph, _MANY_TIMES, tmp_path) as told:
        sources = [graph.node(f"tester{n}").advertise("/in", "std_msgs/Int32", queue_size=10) for n in range(2)]
        while not told:
            for source in sources:
                source.publish({"data": 0})
    assert told == ["30 True"]


def test_a_publisher_that_sends_nonsense_is_left_and_others_are_heard(tmp_path: Path) -> None:
    text = 'subscriber = rospy.Subscriber("in", String, lambda message: tell(message.data))\nrospy.spin()\n'
    with running_graph() as graph, _running(graph, text, tmp_path) as told:
        bad: Any = graph.node("bad").advertise("/in", "std_msgs/String", queue_size=None)
        good = graph.node("good").advertise("/in", "std_msgs/String", queue_size=None)
        graph.until(lambda: bad.has_subscribers and good.has_subscribers)
        good.publish({"data": "one"})
        graph.until(lambda: told == ["one"])
        (link,) = bad._subscriber_links.remote
        link.out.send([(b"\xff\xff\xff\x7f",)], None)
        graph.until(lambda: not bad.has_subscribers or link.transport is None)
        good.publish({"data": "two"})
        graph.until(lambda: told == ["one", "two"])
