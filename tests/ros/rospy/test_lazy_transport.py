"""`topic_tools.LazyTransport`: a node subscribes to its input while its output has subscribers."""

import subprocess
import sys
from pathlib import Path

import pytest
from tests.graphs import PATIENCE_S, running_graph
from tests.ros.rospy.programs import environment

_NODE = """
import rospy
from std_msgs.msg import String
from topic_tools import LazyTransport

class Twice(LazyTransport):
    def __init__(self):
        super().__init__()
        self.pub = self.advertise("out", String, queue_size=1)

    def subscribe(self):
        self.sub = rospy.Subscriber("in", String, lambda message: self.pub.publish(2 * message.data))

    def unsubscribe(self):
        self.sub.unregister()

rospy.init_node("twice")
node = Twice()
rospy.spin()
"""


@pytest.mark.parametrize("is_lazy", [True, False])
def test_inputs_follow_the_outputs(is_lazy: bool, tmp_path: Path) -> None:
    (tmp_path / "twice.py").write_text(_NODE)
    received: list[str] = []
    with running_graph() as graph:
        command = [sys.executable, str(tmp_path / "twice.py"), f"_lazy:={is_lazy}"]
        env = environment(sys.executable, graph.core.uri, tmp_path)
        with subprocess.Popen(command, env=env, stderr=subprocess.PIPE, text=True) as program:
            node = graph.node("tester")
            source = node.advertise("/in", "std_msgs/String")
            if not is_lazy:
                graph.until(lambda: source.has_subscribers)
            output = node.subscribe("/out", "std_msgs/String", lambda message: received.append(message.data))
            try:
                graph.until(lambda: source.has_subscribers and output.publishers)
                graph.until(lambda: source.publish({"data": "so "}) or received)  # until the node knows its subscriber
                output.unregister()
                if is_lazy:
                    graph.until(lambda: not source.has_subscribers)
            finally:
                program.terminate()
            _, errors = program.communicate(timeout=PATIENCE_S)
    assert set(received) == {"so so "}
    assert "Traceback" not in errors
