"""Every subcommand of ROS with Trundle's master and nodes, and the reverse; prints a table."""

import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S
from tests.app.cli.matrix import ROWS, Row

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


PACKAGE = """<package><name>{name}</name><version>1.0.0</version><description>of Debian's</description>
<maintainer email="nobody@example.com">nobody</maintainer><license>BSD</license></package>"""
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
    rospy.logwarn_throttle(0.5, "hello")
    rospy.sleep(0.02)
"""


@contextmanager
def _started(command: Sequence[str], env: dict[str, str], folder: Path) -> Iterator["subprocess.Popen[str]"]:
    """Run a program; kill it after a timeout or at the end of the block."""
    pipes: Any = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    with subprocess.Popen(command, env=env, cwd=folder, text=True, **pipes) as process:
        timeout = threading.Timer(PATIENCE_S, process.kill)
        timeout.start()
        try:
            yield process
        finally:
            timeout.cancel()
            process.kill()


def _run(command: Sequence[str], row: Row, pattern: str, env: dict[str, str], folder: Path) -> str:
    """Run one row; return the error, or empty."""
    with _started(command, env, folder) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        if row.stdin:
            process.stdin.write(row.stdin)
        process.stdin.close()
        output = ""
        for line in process.stdout:
            output += line
            if row.endless and re.search(pattern, output, re.MULTILINE):
                process.send_signal(signal.SIGINT)
                break
        process.stdout.read()
        code = process.wait()
    if not re.search(pattern, output, re.MULTILINE):
        return f"{pattern!r} is not in {output[-300:]!r}"
    return "" if row.endless or code == 0 else f"exit code {code}: {output[-300:]!r}"


def _write_inputs(folder: Path) -> None:
    """Write the rows' inputs: a file, a package with a program, and package.xml for Debian's packages without one."""
    (folder / "p.yaml").write_text("d: 1\n")
    without_manifest = {
        folder.parent
        for pattern in ("*/msg", "*/srv")
        for folder in Path("/usr/share").glob(pattern)
        if not (folder.parent / "package.xml").exists()
    }
    for name in ("fruits", *(package.name for package in without_manifest)):
        (folder / "packages" / name).mkdir(parents=True)
        (folder / "packages" / name / "package.xml").write_text(PACKAGE.format(name=name))
    for package in without_manifest:
        for kind in (package / "msg", package / "srv"):
            if kind.is_dir():
                (folder / "packages" / package.name / kind.name).symlink_to(kind)
    apple = folder / "packages/fruits/apple"
    apple.write_text("#!/bin/sh\necho an apple\n")
    apple.chmod(0o755)


def _report(results: list[tuple[str, str]], title: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Print the table; fail if a row failed."""
    with capsys.disabled():
        print(f"\n{title}")
        for words, error in results:
            state = {"": "ok", _NOT_INSTALLED: "-"}.get(error, "FAIL")
            print(f"  {state:4}  {words}  {error}".rstrip())
    assert [words for words, error in results if error not in ("", _NOT_INSTALLED)] == []


def _run_rows(env: dict[str, str], folder: Path, *, originals: bool) -> list[tuple[str, str]]:
    _write_inputs(folder)
    results: list[tuple[str, str]] = []
    with ExitStack() as background:
        for row in ROWS:
            words = row.original_command if originals else row.trundle
            if not words:
                continue
            command = words.format(folder=folder).split()
            pattern = (row.original_output if originals else None) or row.output
            if not originals:
                command = [sys.executable, "-m", "trundle", *command]
            error = ""
            if originals and not Path(command[0]).exists():
                error = _NOT_INSTALLED
            elif row.background:
                background.enter_context(_started(command, env, folder))
            else:
                error = _run(command, row, pattern, env, folder)
            results.append((words, error))
            if row.trundle.startswith("bag record"):
                (folder / "z.bag").write_bytes((folder / "x.bag").read_bytes())
    return results


def _environment(uri: str, folder: Path) -> dict[str, str]:
    return {
        "PATH": "/usr/bin:/bin",
        "HOME": str(folder),
        "ROS_MASTER_URI": uri,
        "ROS_IP": "127.0.0.1",
        "ROS_DISTRO": "noetic",
        "ROS_PACKAGE_PATH": f"{folder / 'packages'}:/usr/share",
        "PYTHONUNBUFFERED": "1",
        "PYTHONWARNINGS": "ignore",
    }


def test_every_tool_of_ros_works_with_trundles_graph(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
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
                frames.send_transform(Transform(parent="map", child="base", stamp_ns=node.clock.now_ns()))
                node.log.warn("hello")
                await WallClock().sleep(0.02)

        loop.run(node.wait_registered())
        talking = loop.spawn(talk())
        env = _environment(core.uri, tmp_path)
        _report(_run_rows(env, tmp_path, originals=True), "Debian's tools with Trundle's master and node", capsys)
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
    with ExitStack() as programs:
        for program in (
            ["/usr/bin/rosmaster", "--core", "-p", str(port)],
            ["/usr/lib/rosout/rosout"],
            ["/usr/bin/python3", "-c", TALKER],
        ):
            process = programs.enter_context(subprocess.Popen(program, **quiet))
            programs.callback(process.kill)
        _await_service(MasterProxy(uri), "/talker/enable")
        yield uri


def _await_service(master: MasterProxy, name: str) -> None:
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        with suppress(MasterUnreachableError):
            if any(service == name for service, _ in master.call("getSystemState")[2]):
                return
        time.sleep(0.05)
    raise AssertionError(f"no service {name} in time")


@pytest.mark.skipif(not Path("/usr/bin/rosmaster").exists(), reason="Debian's python3-rosmaster is not installed")
def test_every_trundle_command_works_with_the_graph_of_ros(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with _real_graph(tmp_path) as uri:
        env = {**os.environ, **_environment(uri, tmp_path)}
        _report(_run_rows(env, tmp_path, originals=False), "Trundle's commands with Debian's master and node", capsys)
