"""Output equal to ROS' own tools line by line, on the same graph."""

import math
from pathlib import Path
from typing import Any

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.real_ros]

HEADER = {"seq": 3, "stamp": {"secs": 7, "nsecs": 5_000_000}, "frame_id": "laser"}
SPECIAL_FLOATS = [0.1, -0.0, 1e-9, 1e20, math.inf, math.nan]
TOPICS: dict[str, tuple[str, Any]] = {
    "/text": ("std_msgs/String", {"data": 'say "hi"\nto: [me]'}),
    "/umlaut": ("std_msgs/String", {"data": "Bär"}),
    "/flag": ("std_msgs/Bool", {"data": True}),
    "/byte": ("std_msgs/Byte", {"data": -3}),
    "/char": ("std_msgs/Char", {"data": 65}),
    "/small": ("std_msgs/Float32", {"data": 0.1}),
    "/large": ("std_msgs/UInt64", {"data": 2**63}),
    "/when": ("std_msgs/Time", {"data": {"secs": 5, "nsecs": 7}}),
    "/long": ("std_msgs/Duration", {"data": {"secs": -5, "nsecs": 7}}),
    "/nothing": ("std_msgs/Empty", {}),
    "/color": ("std_msgs/ColorRGBA", {"r": 0.5, "a": 1}),
    "/numbers": ("std_msgs/Float64MultiArray", {"data": SPECIAL_FLOATS}),
    "/bytes": ("std_msgs/UInt8MultiArray", {"layout": {"dim": [{"label": "x", "size": 2}]}, "data": [1, 255]}),
    "/twist": ("geometry_msgs/Twist", {"linear": {"x": 0.5}}),
    "/odom": ("nav_msgs/Odometry", {"header": HEADER, "child_frame_id": "base", "pose": {"covariance": [0.1] * 36}}),
    "/scan": ("sensor_msgs/LaserScan", {"header": HEADER, "ranges": SPECIAL_FLOATS}),
    "/joints": ("sensor_msgs/JointState", {"header": HEADER, "name": ["a", "b c", ""], "position": [1, 2.5]}),
    "/picture": ("sensor_msgs/Image", {"encoding": "mono8", "data": bytes([1, 2, 200])}),
    "/cloud": ("sensor_msgs/PointCloud2", {"fields": [{"name": "x", "datatype": 7, "count": 1}], "data": b"\1\2"}),
    "/tree": ("tf2_msgs/TFMessage", {"transforms": [{"header": HEADER, "child_frame_id": "base"}, {}]}),
    "/goals": ("actionlib_msgs/GoalStatusArray", {"status_list": [{"status": 1, "text": "on"}, {"status": 3}]}),
}
ECHOES = [
    *TOPICS,
    *(f"-p {topic}" for topic in TOPICS if topic not in ("/nothing",)),
    "-w 6 /numbers",
    "-w 4 /odom",
    "--nostr /joints",
    "--noarr /joints",
    "--nostr --noarr /tree",
    "--noarr -p /odom",
    "--filter m.linear.x==0.5 /twist",
    "/twist/linear",
    "/twist/linear/x",
    "-p /twist/linear",
    "/joints/position",
    "/joints/position[1]",
    "/joints/name[0:2]",
    "/joints/header/stamp",
    "/tree/transforms[0]",
    "/tree/transforms[0]/header/frame_id",
    "-p /tree/transforms[0]/transform/rotation",
    "/goals/status_list[1]/status",
    "--noarr /numbers/data",
    "--nostr /text/data",
    "--filter m._type=='nav_msgs/Odometry' /odom/header",
    "-n 0 /text",
]
WORDS = [
    *("topic list", "topic list -v", "topic list -p", "topic list -s", "topic list -v -s", "topic list /t"),
    *("topic list --host", "topic list -v --host", "topic info /odom", "topic info /rosout", "topic type /odom"),
    *("topic type /odom/pose/pose", "topic find std_msgs/String", "topic find nav_msgs/None"),
    *("node list", "node list -a", "node list -u", "node list /t", "node info /talker", "node info -q /talker"),
    *("node machine", "node machine 127.0.0.1", "node info /talker /rosout"),
    *("param list", "param list /robot", "param get /robot", "param get /robot/size", "param get -p /robot/parts"),
    *("param get /robot/name", "param get -p /robot", "param dump", "param get /robot/on", "param get /robot/text"),
    *("service list", "service list -n", "service info /talker/switch", "service type /talker/switch"),
    *("service args /talker/switch", "service args /talker/get_loggers", "service find std_srvs/SetBool"),
    *("service uri /talker/switch", "service call /talker/switch true", "service call /talker/get_loggers"),
    *("service args /talker/plan", "service info /talker/plan", "service call -v /talker/plan {tolerance:_1.5}"),
    *("param set -v /new {a:_1,b:_{c:_deg(90)}}", "param load -v {file} /new", "param load -v {file}"),
    *("param dump -v /dev/null /robot", "node machine localhost", "topic echo -n 1 /text relay:=text"),
    *("service call -v /talker/switch true", "service call /talker/switch {data:_true}", "service list /talker"),
    *("msg md5 geometry_msgs/Point", "msg md5 nav_msgs/Odometry", "srv md5 std_srvs/SetBool", "msg md5 Point"),
]


@pytest.fixture
def talker(graph: Any) -> Any:
    """A node with topics of many types, a service, and parameters of every kind."""
    node = graph.node("talker")
    for topic, (kind, fields) in TOPICS.items():
        node.advertise(topic, kind, latch=True).publish(fields)
    node.subscribe("/listened", "std_msgs/String", lambda _: None)
    node.advertise_service("~empty", "std_srvs/Empty", lambda _: {})
    node.advertise_service("~plan", "nav_msgs/GetPlan", lambda _: {"plan": {"poses": [{}]}})
    node.advertise_service(
        "~switch", "std_srvs/SetBool", lambda request: {"success": request.data, "message": "x: 'y'"}
    )
    graph.ready(node)
    values = {"name": "car", "size": 1.5, "on": True, "wheels": 4, "parts": ["a", 2, {"b": 1e-7}], "text": "a\nb: c\n"}
    graph.loop.run(node.params.set("/robot", {**values, "empty": {}, "none": [], "number_text": "5"}))
    return node


@pytest.mark.parametrize("words", ECHOES)
def test_messages_are_printed_like_rostopic(graph: Any, original: Any, talker: Any, words: str) -> None:
    arguments = ["echo", "-n", "1", *words.split()]
    output, expected = graph.trundle("topic", *arguments)[1], original("rostopic", *arguments)
    if words.startswith("-p") and not words.startswith(("-p /odom", "-p /scan", "-p /joints")):
        # Without a header the first column is the time of receipt.
        output, expected = (_without_time(text) for text in (output, expected))
    assert output == expected


@pytest.mark.parametrize("words", WORDS)
def test_the_graph_is_described_like_by_ros(graph: Any, original: Any, talker: Any, tmp_path: Path, words: str) -> None:
    file = tmp_path / "file.yaml"
    file.write_text("a: 1\nb: {c: deg(90)}\n---\n_ns: sub\nd: [1, x]\n")
    spaced = (word.replace("_", " ") if "{" in word else word for word in words.split())
    tool, *arguments = (str(file) if word == "{file}" else word for word in spaced)
    assert graph.trundle(tool, *arguments)[1] == original(f"ros{tool}", *arguments)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        *((2, f"topic echo {words}") for words in ("", "-w 1 /text", "-a /text", "--offset -b x.bag /text", "-n x /a")),
        *((2, f"topic {words}") for words in ("info", "info /a /b", "list -p -s", "hz", "bw -w x /a", "find", "delay")),
        *((2, f"topic pub {words}") for words in ("", "/a", "-r 2 -1 /a std_msgs/String a", "-r 0 /a std_msgs/Int8 1")),
        *((2, f"topic pub {words}") for words in ("/a std_msgs/Int8 [", "-f x.yaml /a std_msgs/Int8 1")),
        *((1, f"topic {words}") for words in ("info /none", "type /none", "pub -1 /a none/None", "echo -b no.bag /a")),
        *((2, f"node {words}") for words in ("info", "ping", "ping -a /talker", "ping -a -c 2", "list a b")),
        *((1, f"node {words}") for words in ("machine no.such.host.invalid", "kill /none")),
        *(
            (2, f"param {words}")
            for words in ("get", "set", "set /a", "set -t a -b b /a", "load", "delete", "list a b")
        ),
        *((1, f"param {words}") for words in ("get /none", "set /a {1:_2}", "load no.yaml", "delete /none")),
        *((2, f"service {words}") for words in ("call", "call /none", "call /talker/empty 1", "args /none", "info")),
        *((1, f"service {words}") for words in ("info /none", "type /none", "uri /none")),
        *((2, f"msg {words}") for words in ("show std_msgs::String", "show a b")),
    ],
)
def test_errors_have_the_exit_codes_of_the_original(
    graph: Any, original: Any, talker: Any, code: int, words: str
) -> None:
    tool, *arguments = (word.replace("_", " ") if ":" in word else word for word in words.split())
    if tool == "msg":
        arguments = words.split()[1:]
    assert graph.trundle(tool, *arguments)[:2] == (code, original(f"ros{tool}", *arguments, code=code))


@pytest.mark.parametrize("words", ["show geometry_msgs/PoseStamped", "show -r std_msgs/String", "package std_msgs"])
def test_types_are_shown_like_rosmsg(graph: Any, original: Any, words: str) -> None:
    if not Path("/usr/share/geometry_msgs/msg").is_dir():
        pytest.skip("Debian's ros-geometry-msgs is not installed")
    assert graph.trundle("msg", *words.split())[1] == original("rosmsg", *words.split(), path=Path("/usr/share"))


def _without_time(text: str) -> str:
    return "\n".join(line.partition(",")[2] for line in text.splitlines())
