"""A message that another thread publishes right after a subscriber's header was answered reaches that subscriber."""

import subprocess
import sys
from pathlib import Path

import pytest
from tests.graphs import running_graph
from tests.ros.rospy.programs import environment

_SERVER = """
import sys, threading, rospy
from std_msgs.msg import String
from trundle.ros.transport.tcpros import FrameProtocol

rospy.init_node("server")
result = rospy.Publisher("result", String, queue_size=10)
send_header = FrameProtocol.send_header
others = int(sys.argv[1])
def send_and_publish(link, fields):
    send_header(link, fields)
    if fields.get("topic") == "/result" and result.get_num_connections() >= others:
        thread = threading.Thread(target=result.publish, args=("done",))
        thread.start()
        thread.join()
        is_answered.set()
is_answered = threading.Event()
while result.get_num_connections() < others:
    rospy.sleep(0.01)
for _ in range(others):
    result.publish("begin")  # from now on, messages are written directly
FrameProtocol.send_header = send_and_publish
ready = rospy.Publisher("ready", String, queue_size=1, latch=True)
ready.publish("")
is_answered.wait()
while result.get_num_connections() < others + 1:
    rospy.sleep(0.01)
result.publish("end")
rospy.spin()
"""


@pytest.mark.parametrize("others", [0, 1])
def test_what_a_new_subscriber_causes_to_be_published_reaches_it(others: int, tmp_path: Path) -> None:
    (tmp_path / "server.py").write_text(_SERVER)
    with running_graph() as graph:
        node = graph.node("tester")
        is_ready: list[object] = []
        node.subscribe("/ready", "std_msgs/String", is_ready.append)
        for number in range(others):
            graph.node(f"other_{number}").subscribe("/result", "std_msgs/String", lambda _: None)
        env = environment(sys.executable, graph.core.uri, tmp_path)
        with subprocess.Popen([sys.executable, str(tmp_path / "server.py"), str(others)], env=env) as program:
            try:
                graph.until(lambda: is_ready)
                got: list[str] = []
                node.subscribe("/result", "std_msgs/String", lambda message: got.append(message.data), queue_size=None)
                graph.until(lambda: got[-1:] == ["end"])
                assert got == ["done", "end"]
            finally:
                program.kill()
