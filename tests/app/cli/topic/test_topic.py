"""`trundle topic`, with rostopic's output."""

import io
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

import trundle.app.cli.topic.pub as topic_pub
from trundle.ros import DelayMeter, Messages, WallClock

STRING = "std_msgs/String"


@contextmanager
def _started(*arguments: str) -> Iterator["subprocess.Popen[str]"]:
    command = [sys.executable, "-m", "trundle", "topic", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                process.kill()


@pytest.fixture
def latched(graph: Any) -> Any:
    """A node with one latched topic for each output format."""
    node = graph.node("latcher")
    for topic, kind, fields in [
        ("/text", STRING, {"data": 'say "hi"\n'}),
        ("/twist", "geometry_msgs/Twist", {"linear": {"x": 0.5}}),
        (
            "/joints",
            "sensor_msgs/JointState",
            {"header": {"stamp": {"secs": 7, "nsecs": 5}}, "name": ["a", "b c"], "position": [1, 2.5]},
        ),
        (
            "/tree",
            "tf2_msgs/TFMessage",
            {"transforms": [{"child_frame_id": "base", "transform": {"rotation": {"w": 1}}}, {}]},
        ),
        ("/picture", "sensor_msgs/Image", {"encoding": "mono8", "data": bytes([1, 2])}),
    ]:
        node.advertise(topic, kind, latch=True).publish(fields)
    graph.ready(node)
    return node


def _echo(graph: Any, *arguments: str) -> str:
    code, out, error = graph.trundle("topic", "echo", "-n", "1", *arguments)
    assert (code, error) == (0, "")
    return out


def test_topics_are_listed(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("/r/a", STRING)
    node.subscribe("/r/b", STRING, print)
    graph.ready(node)
    assert graph.trundle("topic", "list") == (0, "/r/a\n/r/b\n/rosout\n/rosout_agg\n", "")
    assert graph.trundle("topic", "list", "-p", "/r")[1] == "/r/a\n"
    assert graph.trundle("topic", "list", "-s", "/r")[1] == "/r/b\n"
    assert graph.trundle("topic", "list", "-v", "/r")[1] == (
        "\nPublished topics:\n * /r/a [std_msgs/String] 1 publisher\n"
        "\nSubscribed topics:\n * /r/b [std_msgs/String] 1 subscriber\n\n"
    )
    assert graph.trundle("topic", "list", "--host", "-p", "/r")[1] == "Host [127.0.0.1]:\n  /r/a\n"


def test_a_topic_is_described(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    graph.ready(node)
    assert graph.trundle("topic", "info", "/a")[1] == (
        f"Type: std_msgs/String\n\nPublishers: \n * /n ({node.uri})\n\nSubscribers: None\n\n\n"
    )
    assert graph.trundle("topic", "info", "/nope") == (1, "", "ERROR: Unknown topic /nope\n")


def test_types_are_printed_and_topics_found_by_type(graph: Any, latched: Any) -> None:
    assert graph.trundle("topic", "type", "/twist")[1] == "geometry_msgs/Twist\n"
    assert graph.trundle("topic", "type", "/tree/transforms")[1] == (
        "tf2_msgs/TFMessage transforms geometry_msgs/TransformStamped[]\n"
    )
    assert graph.trundle("topic", "type", "/tree/transforms[0]/header/stamp")[1].endswith("header/stamp time\n")
    assert graph.trundle("topic", "find", "geometry_msgs/Twist")[1] == "/twist\n"
    code, _, error = graph.trundle("topic", "type", "/twist/linear/q")
    assert (code, error) == (1, "ERROR: no field named q in geometry_msgs/Vector3; fields here: x, y, z\n")
    assert graph.trundle("topic", "type", "/nope")[0] == 1


def test_messages_are_printed_as_by_rostopic(graph: Any, latched: Any) -> None:
    assert _echo(graph, "/text") == 'data: "say \\"hi\\"\\n"\n---\n'
    assert _echo(graph, "/joints") == (
        "header: \n  seq: 1\n  stamp: \n    secs: 7\n    nsecs:         5\n  frame_id: ''\n"
        "name: \n  - a\n  - b c\nposition: [1.0, 2.5]\nvelocity: []\neffort: []\n---\n"
    )
    assert _echo(graph, "/tree").startswith(
        "transforms: \n  - \n    header: \n      seq: 0\n      stamp: \n        secs: 0\n        nsecs:         0\n"
        "      frame_id: ''\n    child_frame_id: \"base\"\n    transform: \n      translation: \n        x: 0.0\n"
    )
    assert _echo(graph, "/picture").endswith('encoding: "mono8"\nis_bigendian: 0\nstep: 0\ndata: [1, 2]\n---\n')


def test_fields_elements_and_slices_are_printed(graph: Any, latched: Any) -> None:
    assert _echo(graph, "/twist/linear/x") == "0.5\n---\n"
    assert _echo(graph, "/joints/position[1]") == "2.5\n---\n"
    assert _echo(graph, "/joints/header/stamp") == "\nsecs: 7\nnsecs:         5\n---\n"
    assert _echo(graph, "/tree/transforms[:]/child_frame_id") == "\n- base\n- ''\n---\n"


def test_strings_arrays_and_digits_can_be_left_out(graph: Any, latched: Any) -> None:
    assert '<array type: float64, length: 2>"' in _echo(graph, "--noarr", "/joints")
    assert '"<array type: string, length: 2>"' in _echo(graph, "--nostr", "/joints")
    assert 'data: "<string length: 9>"' in _echo(graph, "--nostr", "/text")
    assert _echo(graph, "-w", "4", "/twist").startswith("linear: \n  x: 0.50\n")


def test_messages_are_printed_for_plotting(graph: Any, latched: Any) -> None:
    assert _echo(graph, "-p", "/joints") == (
        "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.name0,field.name1,"
        "field.position0,field.position1\n7000000005,1,7000000005,,a,b c,1.0,2.5\n"
    )


def test_a_filter_selects_messages(graph: Any) -> None:
    node = graph.node("n")
    publisher = node.advertise("/count", "std_msgs/Int32", queue_size=None)

    def burst(_: object) -> None:
        for i in range(5):
            publisher.publish({"data": i})

    publisher = node.advertise("/counts", "std_msgs/Int32", queue_size=None, on_connect=burst)
    graph.ready(node)
    assert _echo(graph, "--filter", "m.data > 2", "/counts") == "data: 3\n---\n"
    assert graph.trundle("topic", "echo", "/counts", "--filter", "m.data >")[0] == 1


@pytest.mark.parametrize(
    ("arguments", "linear", "angular"),
    [
        (["-1", "/cmd", "geometry_msgs/Twist", "{linear: {x: 0.5}, angular: {z: -1}}"], 0.5, -1.0),
        (["/cmd", "geometry_msgs/Twist", "-1", "--", "[2.0, 0.0, 0.0]", "[0.0, 0.0, -1.8]"], 2.0, -1.8),
    ],
    ids=["yaml", "tutorial"],
)
def test_one_message_is_published(
    graph: Any, monkeypatch: pytest.MonkeyPatch, arguments: list[str], linear: float, angular: float
) -> None:
    messages: list[Any] = []
    monkeypatch.setattr(topic_pub, "time", SimpleNamespace(sleep=lambda _: graph.until(lambda: messages)))
    node = graph.node("n")
    node.subscribe("/cmd", "geometry_msgs/Twist", messages.append)
    graph.ready(node)
    code, out, _ = graph.trundle("topic", "pub", *arguments)
    assert (code, out) == (0, "publishing and latching message for 3.0 seconds\n")
    assert [(m.linear.x, m.angular.z) for m in messages] == [(linear, angular)]


def test_messages_are_published_repeatedly_until_ctrl_c(graph: Any) -> None:
    messages: list[Any] = []
    node = graph.node("n")
    node.subscribe("/stamped", "std_msgs/Header", messages.append)
    graph.ready(node)
    with _started("pub", "-r", "50", "-s", "/stamped", "std_msgs/Header", "{stamp: now, frame_id: x}") as process:
        graph.until(lambda: len(messages) > 3)
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 0
        assert process.stderr is not None
        assert process.stderr.read() == ""
    assert messages[1].stamp != messages[2].stamp
    graph.until(lambda: "/stamped" not in graph.trundle("topic", "list", "-p")[1])


def test_a_message_is_latched_until_ctrl_c(graph: Any) -> None:
    with _started("pub", "/greeting", STRING, "hello") as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "publishing and latching message. Press ctrl-C to terminate\n"
        assert _echo(graph, "/greeting") == 'data: "hello"\n---\n'
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 0


def test_a_subscriber_of_another_type_is_one_warning(graph: Any) -> None:
    node = graph.node("listener")
    node.subscribe("/greeting", "std_msgs/Int32", lambda _: None)
    graph.ready(node)
    with _started("pub", "/greeting", STRING, "hello") as process:
        assert process.stderr is not None
        warning = process.stderr.readline()
        assert warning.startswith("[WARN] [")
        assert warning.endswith(
            "]: Could not process inbound connection: topic types do not match: [std_msgs/Int32] vs. [std_msgs/String] "
            "(/listener asks for /greeting)\n"
        )
        assert process.stdout is not None
        assert process.stdout.readline() == "publishing and latching message. Press ctrl-C to terminate\n"
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 0
        assert process.stderr.read() == ""


def test_the_publishing_node_can_be_renamed_and_remapped(graph: Any) -> None:
    words = ("/greeting", STRING, "hello", "__name:=talker", "/greeting:=/welcome", "_rate:=5")
    with _started("pub", *words) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "publishing and latching message. Press ctrl-C to terminate\n"
        assert _echo(graph, "/welcome") == 'data: "hello"\n---\n'
        assert "/talker\n" in graph.trundle("node", "list")[1]


def test_piped_documents_are_published(graph: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    lines: list[str] = []
    node = graph.node("n")
    node.subscribe("/lines", STRING, lambda m: lines.append(m.data))
    graph.ready(node)
    monkeypatch.setattr(topic_pub, "_SUBSCRIBER_S", PATIENCE_S)
    monkeypatch.setattr(sys, "stdin", io.StringIO("data: one\n---\ndata: two\n---\n"))
    assert graph.trundle("topic", "pub", "/lines", STRING)[0] == 0
    graph.until(lambda: lines == ["one", "two"])


def test_a_files_only_message_is_published_repeatedly(graph: Any, tmp_path: Path) -> None:
    file = tmp_path / "line.yaml"
    file.write_text("data: one\n")
    command = [sys.executable, "-m", "trundle", "topic", "pub", "-f", str(file), "/lines", STRING]
    messages: list[Any] = []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            graph.node("n").subscribe("/lines", STRING, messages.append)
            graph.until(lambda: len(messages) > 2)
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0
            assert process.stdout is not None
            assert process.stdout.read() == "Got one message and a rate, publishing repeatedly\n"
        finally:
            process.kill()


def test_namespace_and_master_can_be_arguments(graph: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    node = graph.node("/ns/other")
    node.advertise("rel", STRING, latch=True).publish({"data": "hello"})
    graph.ready(node)
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:9/")
    monkeypatch.setenv("ROS_NAMESPACE", "/elsewhere")
    words = ("__ns:=ns", f"__master:={graph.core.uri}")
    assert graph.trundle("topic", "type", "rel", *words) == (0, "std_msgs/String\n", "")
    assert _echo(graph, "rel", *words) == 'data: "hello"\n---\n'


def test_latching_publishes_only_the_first_piped_document(graph: Any) -> None:
    command = [sys.executable, "-m", "trundle", "topic", "pub", "-l", "/greeting", STRING]
    messages: list[Any] = []
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdin is not None
            assert process.stdout is not None
            graph.node("n").subscribe("/greeting", STRING, messages.append)
            process.stdin.write("data: one\n---\ndata: two\n---\n")
            process.stdin.flush()
            assert process.stdout.readline() == "publishing and latching message. Press ctrl-C to terminate\n"
            graph.until(lambda: messages)
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()
    assert [message.data for message in messages] == ["one"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["/cmd", "geometry_msgs/Twist", "{linaer: 1}"], "has no field 'linaer'; fields here: 'linear', 'angular'\n"),
        (
            ["/cmd", "geometry_msgs/Twits", "{}"],
            "ERROR: no message type 'geometry_msgs/Twits' (did you mean 'geometry_msgs/Twist'?)",
        ),
        (["/cmd", STRING, "[1"], "error: Argument error: "),
        (["/cmd", STRING, "5"], "field 'data' is a string, got 5"),
        (["/cmd", STRING, "-1", "-r", "5", "x"], "You cannot select both -r and -1"),
        (["/cmd", STRING, "--rate=-5", "x"], "rate must be greater than zero"),
    ],
)
def test_errors_are_one_sentence(graph: Any, arguments: list[str], message: str) -> None:
    code, _, error = graph.trundle("topic", "pub", *arguments)
    assert code in (1, 2)
    assert message in error


@pytest.mark.parametrize(
    ("command", "first"),
    [("hz", r"average rate: "), ("bw", r"average: "), ("delay", r"average delay: ")],
    ids=["rate", "bytes", "delay"],
)
def test_messages_are_measured_until_ctrl_c(graph: Any, command: str, first: str) -> None:
    publisher = graph.node("n").advertise("/tick", "geometry_msgs/PointStamped")

    async def tick() -> None:
        while True:
            publisher.publish({"header": "auto"})
            await WallClock().sleep(0.01)

    ticking = graph.loop.spawn(tick())
    with _started(command, "/tick") as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "subscribed to [/tick]\n"
        assert any(line.startswith(first) for line in iter(process.stdout.readline, ""))
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 0
    ticking.cancel()


class _SettableClock(WallClock):
    """Clock that the test sets."""

    now = 0

    def now_ns(self) -> int:
        return self.now


def test_delays_are_measured_from_the_headers_stamp() -> None:
    clock, messages = _SettableClock(), Messages()
    delay = DelayMeter(clock, -1)
    assert delay.text() is None
    for now, stamp in ((100.0, 99.0), (101.0, 100.75), (102.0, 101.25)):
        clock.now = round(now * 1e9)
        delay.add_message(messages.new("nav_msgs/Odometry", {"header": {"stamp": round(stamp * 1e9)}}))
    assert delay.text() == "average delay: 0.500\n\tmin: 0.250s max: 0.750s std dev: 0.25000s window: 3"
    assert delay.text() == "no new messages"


def test_a_topic_without_stamps_has_no_delay(graph: Any, latched: Any) -> None:
    assert graph.trundle("topic", "delay", "/twist") == (
        1,
        "",
        "ERROR: geometry_msgs/Twist has no header, so its messages have no stamp\n",
    )


def test_wrong_usage_exits_with_2(graph: Any) -> None:
    assert graph.trundle("topic", "pub", "/cmd")[0] == 2
    assert graph.trundle("topic", "nonsense")[0] == 2
    code, out, _ = graph.trundle("topic", "--help")
    assert code == 0
    assert "trundle topic list" in out
