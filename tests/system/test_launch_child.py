"""`trundle launch --child` runs nodes for a roslaunch on another machine."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from trundle.ros import Core, GraphLoop, MasterProxy, RpcServer, blocking_call

REAL_PYTHON, REAL_ROSLAUNCH = "/usr/bin/python3", Path("/usr/bin/roslaunch")
_MANIFEST = """<package><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>x</license></package>"""
_TALK = """#!/bin/sh
echo "$ROS_NAMESPACE $GREETING $*" > "$OUT"
case "$1" in stay) exec sleep 1000;; *) exit "$1";; esac
"""
# XML of a child's nodes, as roslaunch writes it.
_XML = """<?xml version="1.0" encoding="utf-8"?>
<launch>
<node pkg="p" type="talk" ns="/deep/" args="{}" output="screen" respawn="False" respawn_delay="0.0" name="one"
 required="{}">
  <remap from="a" to="b" />
  <env name="GREETING" value="hi" />
</node>
<node pkg="p" type="gone" ns="/" args="" respawn="False" respawn_delay="0.0" name="two" required="False">
</node>
</launch>"""
# Debian's roslaunch, with ssh replaced by a local process.
_PARENT = """
import os, socket, subprocess, sys
from roslaunch import parent, remoteprocess, rlutil
class Pipe:
    def __init__(self, file):
        self.file, self.channel = file, self
        os.set_blocking(file.fileno(), False)
    def settimeout(self, _): pass
    def read(self, size):
        data = self.file.read(size)
        if data is None: raise socket.timeout
        return data
    def close(self): self.file.close()
def run(self, command, address, port, username=None, password=None):
    ssh = subprocess.Popen(command, shell=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    ssh.close = ssh.wait
    return (ssh, ssh.stdin, Pipe(ssh.stdout), Pipe(ssh.stderr)), "executed"
remoteprocess.SSHChildROSLaunchProcess._ssh_exec = run
launch = parent.ROSLaunchParent(rlutil.get_or_generate_uuid(None, False), [sys.argv[1]])
launch.start()
launch.spin()
"""

Calls = list[tuple[str, list[Any]]]


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "ws" / "p"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(_MANIFEST)
    (folder / "talk").write_text(_TALK)
    (folder / "talk").chmod(0o755)
    return folder


@pytest.fixture
def loop() -> Iterator[GraphLoop]:
    with GraphLoop() as running:
        yield running


@pytest.fixture
def parent(loop: GraphLoop) -> Iterator[tuple[str, Calls]]:
    """Parent of `far-0` that records its calls."""
    calls: Calls = []

    def answer(method: str, arguments: list[Any]) -> object:
        calls.append((method, arguments))
        known = method != "register" or arguments[0] == "far-0"
        return (1, "", 1) if known else (-1, f"unknown child [{arguments[0]}]", 0)

    server = RpcServer(answer)
    loop.run(server.start("127.0.0.1", 0))
    yield f"http://127.0.0.1:{server.port}/", calls
    loop.run(server.stop())


@pytest.fixture
def child(start, until, loop: GraphLoop, parent: tuple[str, Calls], package: Path, env: dict[str, str]):
    """A registered child, and a function that calls it; the master starts later."""
    uri, calls = parent
    words = ("launch", "-c", "far-0", "-u", uri, "--run_id", "run 7", "--headless", "--sigint-timeout", "5.0")
    running = start(*words, ROS_PACKAGE_PATH=str(package.parent), OUT=str(package / "output"))
    until("it to register", lambda: calls)
    assert calls[0][0] == "register"

    def call(method: str, *arguments: object) -> Any:
        return blocking_call(calls[0][1][1], method, *arguments, timeout_s=60.0)

    return running, call


@pytest.fixture
def core(loop: GraphLoop, env: dict[str, str]) -> Iterator[Callable[[str], None]]:
    cores: list[Core] = []

    def run(run_id: str) -> None:
        cores.append(Core(loop, port=int(env["ROS_MASTER_URI"].rpartition(":")[2]), run_id=run_id))
        loop.run(cores[0].start())

    yield run
    for started in cores:
        loop.run(started.stop())


def test_the_child_runs_the_parents_nodes_until_shutdown(child, core, parent, package: Path, until) -> None:
    running, call = child
    core("run 7")

    assert call("get_pid") == [1, str(running.process.pid), running.process.pid]
    assert call("launch", _XML.format("stay 'x y'", False)) == [1, "launched", [["Process<deep/one-1>"], ["two"]]]
    assert call("get_node_names") == [1, "node names", ["deep/one-1"]]
    assert call("list_processes")[2] == [[["deep/one-1", 1]], []]
    assert call("process_info", "deep/one-1")[2] == {"name": "deep/one-1", "alive": True, "spawn_count": 1}
    assert call("process_info", "two")[0] == -1
    until("the program", lambda: (package / "output").exists() and (package / "output").read_text())
    assert (package / "output").read_text().startswith("/deep hi stay x y a:=b __name:=one __log:=")
    assert call("shutdown") == [1, "success", 1]

    assert running.process.wait(60) == 0
    messages = [arguments for method, arguments in parent[1] if method == "log"]
    assert any("process[deep/one-1]: started with pid" in text for _, level, text in messages if level == 2)
    assert any("no executable 'gone'" in text for _, level, text in messages if level == 8)
    assert all(name == "far-0" for name, _, _ in messages)


@pytest.mark.parametrize(("required", "code"), [(False, 0), (True, 1)])
def test_the_child_reports_dead_processes_and_ends_with_the_last(
    child, core, parent, until, required: bool, code: int
) -> None:
    running, call = child
    core("run 7")
    call("launch", _XML.format("3", required))

    assert running.process.wait(60) == code
    assert ("process_died", ["deep/one-1", 3]) in parent[1]


def test_invalid_requests_are_errors_of_a_running_child(child, core, package: Path) -> None:
    running, call = child
    command = f"<param name='x' command='touch {package}/mark'/>"

    assert call("launch", "<launch>")[:2][0] == -1
    assert call("launch", f"<launch>{command}</launch>") == [
        -1,
        "ERROR: a child sets no parameters; its parent does",
        [[], []],
    ]
    assert "no ROS master answers" in call("launch", _XML.format("0", False))[1]
    core("another run")
    assert "has the run_id another run, not run 7" in call("launch", _XML.format("0", False))[1]
    with pytest.raises(Exception, match="not supported"):
        call("launch", 3)
    assert running.interrupt() == 130
    assert not (package / "mark").exists()
    assert "Traceback" not in running.output()


@pytest.mark.parametrize(
    ("name", "uri", "message"),
    [
        ("near-1", None, "unknown child [near-1]"),
        ("far-0", "http://127.0.0.1:1/", "no roslaunch at http://127.0.0.1:1/ that takes 'far-0' as its child"),
        ("far-0", "nonsense", "no roslaunch at nonsense"),
    ],
)
def test_a_refusing_parent_is_an_error(trundle, parent, name: str, uri: str | None, message: str) -> None:
    done = trundle("launch", "-c", name, "-u", uri or parent[0], "--run_id", "1", "--headless")
    assert (done.returncode, "Traceback" in done.stderr) == (1, False)
    assert message in done.stderr


@pytest.mark.parametrize("words", [["-c", "a"], ["-c", "a", "-u", "b", "--run_id", "c", "x.launch"]])
def test_child_options_require_each_other_and_exclude_files(trundle, words: list[str]) -> None:
    done = trundle("launch", *words)
    assert done.returncode == 2
    assert "launch: error: " in done.stderr


@pytest.mark.real_ros
def test_debians_roslaunch_starts_and_ends_a_child(env: dict[str, str], package: Path, tmp_path: Path, until) -> None:
    if not REAL_ROSLAUNCH.exists():
        pytest.skip("Debian's roslaunch is not installed (make system)")
    loader, file = tmp_path / "loader", package / "far.launch"
    loader.write_text(f'#!/bin/sh\nshift\nexec {sys.executable} -m trundle launch --headless "$@"\n')
    loader.chmod(0o755)
    file.write_text(
        f"""<launch><machine name="far" address="localhost" user="another" env-loader="{loader}" timeout="60"/>
        <param name="kept" value="3"/>
        <node pkg="p" type="talk" name="one" machine="far" args="stay" ns="deep"><remap from="a" to="b"/></node>
        </launch>"""
    )
    output_file = package / "output"
    real_env = {**env, "PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": str(package.parent), "OUT": str(output_file)}
    words = [REAL_PYTHON, "-c", _PARENT, str(file)]
    with subprocess.Popen(words, env=real_env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as real:
        try:
            until("the program", lambda: output_file.exists() and output_file.read_text())
            assert MasterProxy(env["ROS_MASTER_URI"]).call("getParam", "/kept") == 3
            real.terminate()
            output, _ = real.communicate(timeout=60)
        finally:
            real.kill()

    assert output_file.read_text().startswith("/deep  stay a:=b __name:=one")
    assert "[localhost-0]: process[deep/one-1]: started with pid [" in output
    assert "[localhost-0]: [deep/one-1] killing on exit" in output
