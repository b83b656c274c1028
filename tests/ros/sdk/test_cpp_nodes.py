"""Programs of tests/data/sdk, compiled by catkin_make, on a graph with Trundle's master, tools and nodes."""

import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import SOURCE, WAIT_S, Running, require_compiler
from tests.ros.sdk.hostile_peers import attack, listening_ports, request

from trundle.ros import Messages, to_nsec
from trundle.ros.sdk import Headers, Kit, PackageBuilder, find_toolchain, kit_sources
from trundle.ros.xmlrpc.rpc_client import call_value

pytestmark = pytest.mark.slow
_SANITIZERS = "-fsanitize=address,undefined -fno-sanitize-recover=all -O1 -g1"


def test_each_target_is_reported(workspace: Path) -> None:
    log = (workspace / "log").read_text()

    assert re.search(r"program talker \(src/talker.cpp; .*\): built: .*/devel/lib/cpp_nodes/talker\n", log)
    assert re.search(r"program add_two_ints_server .*: built: ", log), "by its OUTPUT_NAME"
    assert re.search(r"library sums .*: built: .*libsums.so\n", log)
    assert re.search(r"program plan .*: not built: moveit/no_such_header.h: No such file or directory\n", log)
    assert "--   not found: no_such_arm, NoSuchLibrary\n" in log
    # Those that need Eigen or OpenCV are not built where the machine has neither.
    assert re.search(r"[123] C\+\+ targets? (is|are) not built; all else runs as it is", log)


def test_only_headers_of_the_kit_are_used(workspace: Path) -> None:
    """A ROS of Debian in /usr/include would mix two libraries of one name."""
    ninja = find_toolchain(os.environ).ninja
    build = workspace / "build/cpp_nodes"
    used = subprocess.run([ninja, "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout

    assert "/ros/ros.h" in used
    assert not re.search(r"/usr/include/(ros|std_msgs|geometry_msgs|xmlrpcpp|rosgraph_msgs)/", used)


def test_the_checks_of_the_api_pass(running: Running) -> None:
    process = running.start("checks", "--kept", "from:=to", "_from_command_line:=1.25", "_flag:=true")
    output, _ = process.communicate(timeout=WAIT_S)

    assert re.search(r"^\d\d+ checks, 0 failed$", output, re.MULTILINE), output
    assert process.returncode == 0
    assert output.count("shown once") == 1
    assert re.search(r"^\[ERROR\] \[\d+\.\d{9}\]: a stream, 3$", output, re.MULTILINE)
    assert "not shown" not in output


def test_a_talker_and_a_service_answer_python_nodes(running: Running, graph: Graph, messages: Messages) -> None:
    node = graph.node("tester")
    heard: list[str] = []
    logged: list[str] = []
    node.subscribe("/said", "std_msgs/String", lambda message: heard.append(message.data))
    node.subscribe("/rosout", "rosgraph_msgs/Log", lambda message: logged.append(message.msg))
    talker = running.start("talker", "chatter:=said", "__name:=speaker")
    server = running.start("add_two_ints_server", "_greeting:=good day")
    until(lambda: len(heard) > 3)
    assert re.fullmatch(r"hello world \d+", heard[0])
    until(lambda: any(text.startswith("hello world") for text in logged))

    echoed: list[str] = []
    node.subscribe("/echo", "std_msgs/String", lambda message: echoed.append(message.data))
    words = node.advertise("/words", "std_msgs/String", latch=True)
    words.publish(messages.new("std_msgs/String", {"data": "world"}))
    until(lambda: echoed)
    assert echoed == ["good day world"]

    tool = [sys.executable, "-m", "trundle", "service", "call", "/add_two_ints", "4", "5"]
    called = subprocess.run(tool, env=running.environment, capture_output=True, text=True, check=False)
    assert (called.stdout, called.returncode) == ("sum: 9\n", 0), called.stderr

    for process in (talker, server):
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=WAIT_S)
        assert process.returncode == 0
    assert "bye" in output, "the program goes on after spin()"


def test_a_program_answers_the_request_to_shut_down(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    ticks: list[float] = []
    node.subscribe("/add_two_ints_server/ticks", "std_msgs/Float64", lambda message: ticks.append(message.data))
    server = running.start("add_two_ints_server", "_tells:=true")
    until(lambda: ticks)
    tool = [sys.executable, "-m", "trundle", "node", "kill", "/add_two_ints_server"]
    subprocess.run(tool, env=running.environment, check=True, capture_output=True)
    output, _ = server.communicate(timeout=WAIT_S)

    assert re.search(r"asked: .+; latched 1 0, readers 1$", output, re.MULTILINE), output
    assert output.rstrip().endswith("bye")


def test_a_new_subscriber_gets_each_message_after_the_latched_one_once(running: Running, graph: Graph) -> None:
    running.start("latched")
    master = graph.core.uri
    fields = ("topic=/numbers", "md5sum=304a39449588c7f8ce2df6e8001c5fce", "type=std_msgs/UInt32", "callerid=/peer")
    packed = b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields)
    until(lambda: ["/numbers", ["/latched"]] in graph.loop.run(call_value(master, "getSystemState", "/peer"))[0])
    uri = graph.loop.run(call_value(master, "lookupNode", "/peer", "/latched"))
    address = graph.loop.run(call_value(uri, "requestTopic", "/peer", "/numbers", [["TCPROS"]]))[1:]

    def first_numbers() -> list[int]:
        with socket.create_connection(address) as peer, peer.makefile("rb") as stream:
            peer.sendall(struct.pack("<I", len(packed)) + packed)
            stream.read(*struct.unpack("<I", stream.read(4)))
            return [number for (number,) in struct.iter_unpack("<4xI", stream.read(5 * 8))]

    for _ in range(300):
        first = first_numbers()
        assert first == list(range(first[0], first[0] + 5))


def test_statistics_of_topics_are_published_where_the_parameter_says_so(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/enable_statistics", True))
    published: list[Any] = []
    node.subscribe("/statistics", "rosgraph_msgs/TopicStatistics", published.append)
    running.start("add_two_ints_server")
    running.start("talker", "chatter:=words")
    until(lambda: len(published) > 1)

    latest = published[-1]
    assert (latest.topic, latest.node_pub, latest.node_sub) == ("/words", "/talker", "/add_two_ints_server")
    assert latest.delivered_msgs > 1
    assert latest.traffic >= latest.delivered_msgs * len("....hello world 0")
    window_ns = to_nsec(latest.window_stop) - to_nsec(latest.window_start)
    assert 0 < to_nsec(latest.period_mean) * (latest.delivered_msgs - 1) <= window_ns + 1000
    assert to_nsec(latest.period_mean) <= to_nsec(latest.period_max)
    assert to_nsec(latest.stamp_age_max) == 0, "its messages have no header"


def test_hostile_peers_do_not_end_a_node(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    ticks: list[float] = []
    node.subscribe("/add_two_ints_server/ticks", "std_msgs/Float64", lambda message: ticks.append(message.data))
    server = running.start("add_two_ints_server")
    until(lambda: ticks)
    attack(server.pid)
    count = len(ticks)
    until(lambda: len(ticks) > count + 3)
    assert server.poll() is None


def test_a_web_page_is_refused(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    ticks: list[float] = []
    node.subscribe("/add_two_ints_server/ticks", "std_msgs/Float64", lambda message: ticks.append(message.data))
    server = running.start("add_two_ints_server")
    until(lambda: ticks)
    body = b"<?xml version='1.0'?><methodCall><methodName>getPid</methodName><params></params></methodCall>"
    answers: list[bytes] = []
    for port in listening_ports(server.pid):
        for sent in (request(body), request(body).replace(b"\r\n", b"\r\nOrigin: http://page.example\r\n", 1)):
            with socket.create_connection(("127.0.0.1", port)) as peer:
                peer.sendall(sent)
                peer.settimeout(2)
                with suppress(OSError):
                    answers.append(peer.recv(4096))
    assert any(b"200 OK" in answer and str(server.pid).encode() in answer for answer in answers)
    assert any(answer.startswith(b"HTTP/1.1 403") for answer in answers)


def test_simulated_time_drives_timers(running: Running, graph: Graph, messages: Messages) -> None:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/use_sim_time", True))
    ticks: list[float] = []
    node.subscribe("/add_two_ints_server/ticks", "std_msgs/Float64", lambda message: ticks.append(message.data))
    clock = node.advertise("/clock", "rosgraph_msgs/Clock")
    server = running.start("add_two_ints_server")
    second = 0

    def advance() -> int:
        nonlocal second
        second += 1
        clock.publish(messages.new("rosgraph_msgs/Clock", {"clock": {"sec": 100 + second, "nanosec": 0}}))
        return len(ticks)

    until(lambda: advance() > 3)
    assert all(100 < tick < 101 + second for tick in ticks)
    assert server.poll() is None


def test_frames_are_those_of_the_graph(running: Running, graph: Graph, messages: Messages) -> None:
    """Frames of the program, and one that a Python node broadcasts."""
    node = graph.node("tester")
    heard: set[str] = set()
    node.subscribe(
        "/tf", "tf2_msgs/TFMessage", lambda message: heard.update(t.child_frame_id for t in message.transforms)
    )
    static = node.advertise("/tf_static", "tf2_msgs/TFMessage", latch=True)
    header = {"frame_id": "base"}
    transform = {"translation": {"z": 7.0}, "rotation": {"w": 1.0}}
    tree = [{"header": header, "child_frame_id": "mast", "transform": transform}]
    static.publish(messages.new("tf2_msgs/TFMessage", {"transforms": tree}))
    process = running.start("frames", "mast", package="cpp_frames")
    output, _ = process.communicate(timeout=WAIT_S)

    assert re.search(r"^\d{3} checks, 0 failed$", output, re.MULTILINE), output
    assert process.returncode == 0
    assert heard == {"base"}


def test_an_action_runs_is_canceled_and_replaced(running: Running) -> None:
    process = running.start("count", "--check", package="cpp_actions")
    output, _ = process.communicate(timeout=WAIT_S)

    assert re.search(r"^23 checks, 0 failed$", output, re.MULTILINE), output
    assert process.returncode == 0


def test_goals_are_worked_on_at_the_same_time(running: Running) -> None:
    process = running.start("many", package="cpp_actions")
    output, _ = process.communicate(timeout=WAIT_S)

    assert re.search(r"^\d\d checks, 0 failed$", output, re.MULTILINE), output
    assert process.returncode == 0


@pytest.fixture
def sanitized_kit(tmp_path: Path) -> Kit:
    """The libraries of roscpp alone, compiled with sanitizers."""
    require_compiler()
    toolchain, sources, folder = find_toolchain(os.environ), kit_sources(), tmp_path / "kit"
    headers = Headers({}, folder / "include", folder / "include", provided=sources)
    headers.write_included([sources])
    configure = [
        *(toolchain.cmake, "-S", sources, "-B", tmp_path / "kit_build", "-G", "Ninja"),
        *(f"-DCMAKE_MAKE_PROGRAM={toolchain.ninja}", f"-DCMAKE_CXX_COMPILER={toolchain.compiler}"),
        *(f"-DCMAKE_CXX_FLAGS={_SANITIZERS}", "-DCMAKE_BUILD_TYPE=None", f"-DTRUNDLE_MESSAGES={folder / 'include'}"),
        *(f"-DCMAKE_LIBRARY_OUTPUT_DIRECTORY={folder / 'lib'}", f"-DTRUNDLE_BOOST={toolchain.boost or '/usr'}/include"),
    ]
    subprocess.run(configure, check=True)
    subprocess.run([toolchain.ninja, "-C", tmp_path / "kit_build", "roscpp", "roslib"], check=True)
    return Kit(sources, folder)


def test_the_checks_pass_with_sanitizers(sanitized_kit: Kit, tmp_path: Path, graph: Graph) -> None:
    package = tmp_path / "src/cpp_nodes"
    shutil.copytree(SOURCE / "cpp_nodes", package)
    builder = PackageBuilder(
        sanitized_kit,
        find_toolchain(os.environ),
        build=tmp_path / "build",
        devel=tmp_path / "devel",
        install=tmp_path / "install",
        underlays=[],
        definitions=[f"-DCMAKE_CXX_FLAGS={_SANITIZERS}", "-DCMAKE_BUILD_TYPE=None"],
        environment=os.environ,
    )
    include = sanitized_kit.folder / "include"
    headers = Headers({"cpp_nodes": package}, tmp_path / "devel/include", include, provided=sanitized_kit.sources)
    headers.write_package("cpp_nodes")
    headers.write_included([package])
    *lines, result = builder.build("cpp_nodes", package, jobs=None, targets=["checks"])
    assert not isinstance(result, str)
    assert result.failures == {}, lines
    arguments = ("--kept", "from:=to", "_from_command_line:=1.25", "_flag:=true")
    process = Running(tmp_path, graph.core.uri).start("checks", *arguments)
    output, _ = process.communicate(timeout=10 * WAIT_S)
    assert process.returncode == 0, output
    assert "0 failed" in output
