"""Every subcommand of the originals against our master and nodes, and each of ours against theirs; it prints itself."""

import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from tests.cli.conftest import PATIENCE_S

from trundle.ros import (
    Core,
    GraphLoop,
    MasterProxy,
    MasterUnreachableError,
    Node,
    Transform,
    TransformBroadcaster,
    WallClock,
)

pytestmark = [
    pytest.mark.slow,
    pytest.mark.real_ros,
    pytest.mark.skipif(not Path("/usr/bin/rostopic").exists(), reason="Debian's ROS 1 tools are not installed"),
]


@dataclass(frozen=True)
class Row:
    """One subcommand: what to run in either world, and what it has to say."""

    tool: str
    words: str
    says: str
    typed: str | None = None
    endless: bool = False
    """It is ended by Ctrl-C once it has said so."""
    reads_texts: bool = False
    """Whether the original wants the .msg and .srv files of Debian's ros-*-msgs packages."""


ROWS = [
    Row("topic", "list", "/chatter"),
    Row("topic", "list -v", r"\* /chatter \[std_msgs/String\] 1 publisher"),
    Row("topic", "info /chatter", "Type: std_msgs/String"),
    Row("topic", "type /chatter", "^std_msgs/String$"),
    Row("topic", "find std_msgs/String", "/chatter"),
    Row("topic", "echo -n 1 /chatter", 'data: "hello"'),
    Row("topic", "echo -n 1 -p /tick", "%time,field.header.seq"),
    Row("topic", "pub -1 /heard std_msgs/String hi", "publishing and latching"),
    Row("topic", "hz /tick", "average rate: ", endless=True),
    Row("topic", "bw /tick", "average: ", endless=True),
    Row("topic", "delay /tick", "average delay: ", endless=True),
    Row("node", "list", "/talker"),
    Row("node", "info /talker", r"Publications:(.|\n)*/chatter \[std_msgs/String\](.|\n)*Pid: \d+"),
    Row("node", "ping -c 1 /talker", "xmlrpc reply from http://"),
    Row("node", "machine", r"127\.0\.0\.1|localhost"),
    Row("node", "cleanup", "", typed="n\n"),
    Row("param", "set /a/b 5", ""),
    Row("param", "get /a/b", "^5$"),
    Row("param", "list", "/a/b"),
    Row("param", "load {folder}/p.yaml /c", ""),
    Row("param", "dump {folder}/out.yaml /c", ""),
    Row("param", "get /c", "d: 1"),
    Row("param", "delete /a/b", ""),
    Row("service", "list", "/talker/enable"),
    Row("service", "info /talker/enable", "Type: std_srvs/SetBool"),
    Row("service", "type /talker/enable", "^std_srvs/SetBool$"),
    Row("service", "uri /talker/enable", "^rosrpc://"),
    Row("service", "args /talker/enable", "^data$"),
    Row("service", "find std_srvs/SetBool", "/talker/enable"),
    Row("service", "node /talker/enable", "^/talker$"),
    Row("service", "call /talker/enable true", "success: True"),
    Row("msg", "show geometry_msgs/Point", "float64 x", reads_texts=True),
    Row("msg", "md5 geometry_msgs/Point", "^4a842b65f413084dc2b10fb484ea7f17$"),
    Row("msg", "package geometry_msgs", "geometry_msgs/Point", reads_texts=True),
    Row("msg", "packages", "geometry_msgs", reads_texts=True),
    Row("msg", "list", "geometry_msgs/Point", reads_texts=True),
    Row("srv", "show std_srvs/SetBool", "bool success", reads_texts=True),
    Row("srv", "md5 std_srvs/SetBool", "^09fb03525b03e7ea1fd3992bafd87e16$"),
    Row("srv", "package std_srvs", "std_srvs/Empty", reads_texts=True),
    Row("srv", "packages", "std_srvs", reads_texts=True),
    Row("srv", "list", "std_srvs/Empty", reads_texts=True),
    Row("bag", "record -O {folder}/x.bag -l 3 /tick", ""),
    Row("bag", "info {folder}/x.bag", "/tick +3 msgs"),
    Row("bag", "check {folder}/x.bag", "does not need any migrations", reads_texts=True),
    Row("bag", "filter {folder}/x.bag {folder}/y.bag topic=='/tick'", ""),
    Row("bag", "compress {folder}/x.bag", ""),
    Row("bag", "decompress {folder}/y.bag", ""),
    Row("bag", "reindex {folder}/z.bag", ""),
    Row("bag", "fix {folder}/x.bag {folder}/w.bag", "migrated successfully"),
    Row("bag", "play -i -d 0 -q {folder}/x.bag", ""),
    Row("tf", "echo map base", "At time ", endless=True),
    Row("node", "kill /talker", "killed"),
]
ORIGINALS = {
    "topic": ["/usr/bin/rostopic"],
    "node": ["/usr/bin/rosnode"],
    "param": ["/usr/bin/rosparam"],
    "service": ["/usr/bin/rosservice"],
    "msg": ["/usr/bin/rosmsg"],
    "srv": ["/usr/bin/rossrv"],
    "bag": ["/usr/bin/rosbag"],
    "tf": ["/usr/lib/tf/tf_echo"],
}
_TEXTS = Path("/usr/share/geometry_msgs/msg/Point.msg")
_NOT_INSTALLED = "(not installed)"
TALKER = """
import rospy, std_msgs.msg, std_srvs.srv, geometry_msgs.msg, tf2_msgs.msg
rospy.init_node("talker")
chatter = rospy.Publisher("chatter", std_msgs.msg.String, queue_size=1, latch=True)
chatter.publish("hello")
tick = rospy.Publisher("tick", geometry_msgs.msg.PointStamped, queue_size=1)
tf = rospy.Publisher("tf", tf2_msgs.msg.TFMessage, queue_size=1)
rospy.Service("~enable", std_srvs.srv.SetBool, lambda r: std_srvs.srv.SetBoolResponse(r.data, ""))
while not rospy.is_shutdown():
    p = geometry_msgs.msg.PointStamped(); p.header.stamp = rospy.Time.now(); tick.publish(p)
    t = geometry_msgs.msg.TransformStamped(); t.header.stamp = p.header.stamp
    t.header.frame_id, t.child_frame_id, t.transform.rotation.w = "map", "base", 1.0
    tf.publish(tf2_msgs.msg.TFMessage([t]))
    rospy.sleep(0.02)
"""


def _run(command: Sequence[str], row: Row, env: dict[str, str], folder: Path) -> str:
    """Run one row; empty if it did what it should, else what was wrong."""
    with subprocess.Popen(
        command,
        env=env,
        cwd=folder,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        guard = threading.Timer(PATIENCE_S, process.kill)
        guard.start()
        try:
            assert process.stdin is not None
            assert process.stdout is not None
            if row.typed:
                process.stdin.write(row.typed)
            process.stdin.close()
            said = ""
            for line in process.stdout:
                said += line
                if row.endless and re.search(row.says, said, re.MULTILINE):
                    process.send_signal(signal.SIGINT)
                    break
            process.stdout.read()
            code = process.wait()
        finally:
            guard.cancel()
            process.kill()
    if not re.search(row.says, said, re.MULTILINE):
        return f"{row.says!r} is not in {said[-300:]!r}"
    return "" if row.endless or code == 0 else f"exit code {code}: {said[-300:]!r}"


def _fill(folder: Path) -> None:
    """What the rows read."""
    (folder / "p.yaml").write_text("d: 1\n")


def _judge(results: list[tuple[str, str]], title: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Print the table; fail if a row did."""
    with capsys.disabled():
        print(f"\n{title}")
        for words, wrong in results:
            verdict = {"": "ok", _NOT_INSTALLED: "-"}.get(wrong, "FAIL")
            print(f"  {verdict:4}  {words}  {wrong}".rstrip())
    assert [words for words, wrong in results if wrong not in ("", _NOT_INSTALLED)] == []


def _go(env: dict[str, str], folder: Path, commands: dict[str, list[str]]) -> list[tuple[str, str]]:
    _fill(folder)
    results: list[tuple[str, str]] = []
    for row in ROWS:
        program = commands.get(row.tool)
        is_theirs = program is not None and program[0].startswith("/usr")
        if program is None or not Path(program[0]).exists() or (is_theirs and row.reads_texts and not _TEXTS.exists()):
            results.append((f"{row.tool} {row.words}", _NOT_INSTALLED))
            continue
        words = row.words.format(folder=folder).split()
        if program[-1].endswith("tf_echo"):
            words = words[1:]
        results.append((f"{Path(program[-1]).name} {row.words}", _run([*program, *words], row, env, folder)))
        if row.words.startswith("record"):
            (folder / "z.bag").write_bytes((folder / "x.bag").read_bytes())
    return results


def _environment(uri: str, folder: Path) -> dict[str, str]:
    return {
        "PATH": f"{Path(sys.executable).parent}:/usr/bin:/bin",
        "HOME": str(folder),
        "ROS_MASTER_URI": uri,
        "ROS_IP": "127.0.0.1",
        "ROS_DISTRO": "noetic",
        "PYTHONUNBUFFERED": "1",
        "PYTHONWARNINGS": "ignore",
    }


def test_every_original_tool_works_on_our_graph(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        node = Node("/talker", loop=loop, master_uri=core.uri)
        node.advertise("/chatter", "std_msgs/String", latch=True).publish({"data": "hello"})
        tick, frames = node.advertise("/tick", "geometry_msgs/PointStamped"), TransformBroadcaster(node)
        node.advertise_service("~enable", "std_srvs/SetBool", lambda request: {"success": request.data})

        async def talk() -> None:
            while not node.is_shut_down:
                tick.publish({"header": "auto"})
                frames.send(Transform(parent="map", child="base", stamp_ns=node.clock.now_ns()))
                await WallClock().sleep(0.02)

        loop.run(node.ready())
        talking = loop.spawn(talk())
        env = _environment(core.uri, tmp_path)
        _judge(_go(env, tmp_path, ORIGINALS), "Debian's tools on our master and node", capsys)
        talking.cancel()
        loop.run(core.stop(), PATIENCE_S)


@contextmanager
def _real_graph(folder: Path) -> Iterator[str]:
    """The real master with a real node; yields its URI."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    uri = f"http://127.0.0.1:{port}"
    env = _environment(uri, folder)
    quiet: Any = {"env": env, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    master = subprocess.Popen(["/usr/bin/rosmaster", "--core", "-p", str(port)], **quiet)
    talker = subprocess.Popen(["/usr/bin/python3", "-c", TALKER], **quiet)
    with master, talker:
        try:
            _await_service(MasterProxy(uri), "/talker/enable")
            yield uri
        finally:
            talker.kill()
            master.kill()


def _await_service(master: MasterProxy, name: str) -> None:
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        with suppress(MasterUnreachableError):
            if any(service == name for service, _ in master.call("getSystemState")[2]):
                return
        time.sleep(0.05)
    raise AssertionError(f"no service {name} in time")


@pytest.mark.skipif(not Path("/usr/bin/rosmaster").exists(), reason="Debian's python3-rosmaster is not installed")
def test_every_tool_of_ours_works_on_a_real_graph(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with _real_graph(tmp_path) as uri:
        program = [sys.executable, "-m", "trundle"]
        ours = {tool: [*program, tool] for tool in ORIGINALS}
        env = {**os.environ, **_environment(uri, tmp_path)}
        _judge(_go(env, tmp_path, ours), "our tools on Debian's master and node", capsys)
