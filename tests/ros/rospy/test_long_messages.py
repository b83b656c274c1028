"""Long messages from another process of this machine, through shared memory that is reused."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, running_graph
from tests.ros.rospy.programs import environment

_COUNT, _LENGTH = 60, 100_000
"""More data than fits into the shared memory."""
_NODE = """
import rospy
from {package}.msg import {name}

rospy.init_node("keeper")
kept = []
subscriber = rospy.Subscriber("in", {name}, kept.append)
while len(kept) < {count} and not rospy.is_shutdown():
    rospy.sleep(0.01)
for message in kept:
    print(message.header.frame_id, type(message.data).__name__, len(message.data), *sorted(set(message.data)))
"""


@pytest.mark.parametrize(
    ("kind", "container"),
    [
        ("sensor_msgs/Image", "bytes"),
        ("nav_msgs/OccupancyGrid", "tuple"),
    ],
)
def test_kept_messages_do_not_change_when_the_shared_memory_is_reused(
    kind: str, container: str, tmp_path: Path
) -> None:
    package, _, name = kind.partition("/")
    (tmp_path / "keeper.py").write_text(_NODE.format(package=package, name=name, count=_COUNT))
    with running_graph() as graph:
        env = environment(sys.executable, graph.core.uri, tmp_path)
        command = [sys.executable, str(tmp_path / "keeper.py")]
        with subprocess.Popen(command, env=env, stdout=subprocess.PIPE, text=True) as program:
            node = graph.node("tester")
            source = node.advertise("/in", kind, queue_size=None)
            graph.until(lambda: source.has_subscribers)
            for number in range(_COUNT):
                data: Any = [number] * _LENGTH
                source.publish({"header": {"frame_id": str(number)}, "data": data})
            printed, _ = program.communicate(timeout=PATIENCE_S)
    assert printed.splitlines() == [f"{number} {container} {_LENGTH} {number}" for number in range(_COUNT)]


_SLOW_NODE = """
import rospy, rospy.subscription
from sensor_msgs.msg import Image

rospy.subscription._MAX_WAITING_BYTES = 1_000_000  # ten messages
rospy.init_node("slow")
kept = []
def keep(message):
    if not kept:
        rospy.sleep(1.0)
    kept.append(message.header.frame_id)
subscriber = rospy.Subscriber("in", Image, keep)
while "last" not in kept and not rospy.is_shutdown():
    rospy.sleep(0.01)
print(*kept)
"""


def test_a_slow_callback_loses_no_messages(tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text(_SLOW_NODE)
    names = [*map(str, range(300)), "last"]
    with running_graph() as graph:
        env = environment(sys.executable, graph.core.uri, tmp_path)
        with subprocess.Popen([sys.executable, str(tmp_path / "slow.py")], env=env, stdout=subprocess.PIPE) as program:
            node = graph.node("tester")
            source = node.advertise("/in", "sensor_msgs/Image", queue_size=None)
            graph.until(lambda: source.has_subscribers)
            for name in names:
                source.publish({"header": {"frame_id": name}, "data": bytes(_LENGTH)})
            printed, _ = program.communicate(timeout=PATIENCE_S)
    assert printed.decode().split() == names


_FAST_NODE = """
import sys, rospy
from sensor_msgs.msg import Image

rospy.init_node("fast")
publisher = rospy.Publisher("out", Image, queue_size=3)
while not publisher.get_num_connections() and not rospy.is_shutdown():
    rospy.sleep(0.01)
sys.setswitchinterval(1000.0)  # the thread that publishes never has to leave the interpreter to others
image = Image(data=bytes(100_000))
while not rospy.is_shutdown():
    publisher.publish(image)
"""


def test_a_thread_that_publishes_without_pause_leaves_the_interpreter_to_the_sender(tmp_path: Path) -> None:
    (tmp_path / "fast.py").write_text(_FAST_NODE)
    received: list[int] = []
    with running_graph() as graph:
        env = environment(sys.executable, graph.core.uri, tmp_path)
        with subprocess.Popen([sys.executable, str(tmp_path / "fast.py")], env=env) as program:
            node = graph.node("tester")
            node.subscribe("/out", "sensor_msgs/Image", lambda message: received.append(len(message.data)))
            try:
                graph.until(lambda: len(received) >= 300)
            finally:
                program.kill()
    assert {*received} == {100_000}
