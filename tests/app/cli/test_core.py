"""`trundle core`: start, requests and shutdown."""

import os
import signal
import subprocess
import sys
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from trundle.app.cli import main
from trundle.ros import MasterError, MasterProxy


@contextmanager
def _core(*arguments: str, logs: Path, shell: Sequence[str] = ()) -> Generator["tuple[subprocess.Popen[str], str]"]:
    command = [*shell, sys.executable, "-m", "trundle", "core", "-p", "0", *arguments]
    env = {**os.environ, "ROS_LOG_DIR": str(logs)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=env) as process:
        try:
            assert process.stdout is not None
            name, _, uri = process.stdout.readline().strip().partition("=")
            assert name == "ROS_MASTER_URI"
            yield process, uri
        finally:
            if process.poll() is None:
                process.kill()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_the_master_answers_until_a_signal_stops_it(number: signal.Signals, tmp_path: Path) -> None:
    with _core(logs=tmp_path) as (process, uri):
        assert MasterProxy(uri).call("getSystemState")[0] == [["/rosout_agg", ["/rosout"]]]
        process.send_signal(number)
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "Traceback" not in process.stderr.read()


def test_a_background_job_of_a_script_handles_sigint(tmp_path: Path) -> None:
    """`roscore & … kill -INT $!`: the shell starts background jobs with SIGINT ignored."""
    with _core(logs=tmp_path, shell=["sh", "-c", "trap '' INT; exec \"$@\"", "sh"]) as (process, _):
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0


def test_a_shutdown_request_stops_the_master(tmp_path: Path) -> None:
    switches = ("-w", "3", "-t", "3", "--sigint-timeout=9", "--sigterm-timeout=2")
    with _core("--distro", "indigo", *switches, logs=tmp_path) as (process, uri):
        assert MasterProxy(uri).call("getParam", "/rosdistro") == "indigo\n"
        MasterProxy(uri, "/me").call("shutdown", "enough")
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "external shutdown request from [/me]: enough" in process.stderr.read()


def test_listening_on_all_addresses_is_a_warning(tmp_path: Path) -> None:
    with _core("--host", "0.0.0.0", logs=tmp_path) as (process, _):
        process.send_signal(signal.SIGTERM)
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "listening on 0.0.0.0: ROS 1 has no passwords" in process.stderr.read()


def test_an_address_of_another_machine_is_an_error(capfd: pytest.CaptureFixture[str], monkeypatch: Any) -> None:
    """192.0.2.1 is unassigned (RFC 5737), so nothing answers."""
    monkeypatch.setattr("trundle.app.cli.core._CONNECT_S", 0.5)
    monkeypatch.setattr("signal.signal", lambda *_: None)
    monkeypatch.setenv("ROS_IP", "192.0.2.1")
    assert main(["core", "-p", "0", "--host", "0.0.0.0"]) == 1
    error = capfd.readouterr().err
    assert "nothing answers at http://192.0.2.1:" in error
    assert "set ROS_IP or ROS_HOSTNAME" in error
    assert "Traceback" not in error


@pytest.mark.parametrize(
    ("uri", "warning"),
    [
        ("http://localhost:11977", "ROS_MASTER_URI port [11977] does not match this roscore [{port}]"),
        ("http://192.0.2.1:11977", "ROS_MASTER_URI [http://192.0.2.1:11977] host is not set to this machine"),
        ("nonsense", "ROS_MASTER_URI is"),
    ],
)
def test_a_master_uri_of_another_master_is_a_warning(graph: Any, monkeypatch: Any, uri: str, warning: str) -> None:
    """The port is in use, so that the command exits at once."""
    monkeypatch.setattr("signal.signal", lambda *_: None)
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    _, _, error = graph.trundle("core", "-p", str(graph.core.port))
    assert f"WARNING: {warning.format(port=graph.core.port)}" in error


def test_a_master_uri_of_this_master_is_no_warning(graph: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr("signal.signal", lambda *_: None)
    monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{graph.core.port}/")
    assert "WARNING" not in graph.trundle("core", "-p", str(graph.core.port))[2]


def test_rosout_is_restarted_after_node_kill(graph: Any) -> None:
    messages: list[Any] = []
    node = graph.node("listener")
    node.subscribe("/rosout_agg", "rosgraph_msgs/Log", messages.append, queue_size=None)
    graph.ready(node)
    before = MasterProxy(graph.core.uri).call("lookupNode", "/rosout")
    assert graph.trundle("node", "kill", "/rosout")[0] == 0

    def is_new() -> bool:
        try:
            return MasterProxy(graph.core.uri).call("lookupNode", "/rosout") != before
        except MasterError:  # the old node is unregistered, the new one not yet registered
            return False

    graph.until(is_new)
    graph.until(lambda: node.log.info("hello") or any(message.msg == "hello" for message in messages))


def test_an_unknown_distribution_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["core", "--distro", "ardent"]) == 2
    assert "indigo" in capsys.readouterr().err


def test_a_port_in_use_is_an_error_of_one_line(graph: Any) -> None:
    code, out, error = graph.trundle("core", "-p", str(graph.core.port))
    assert (code, out) == (1, "")
    assert error.count("\n") == 1
    assert f"port {graph.core.port} on 127.0.0.1 is taken" in error
    assert "-p PORT" in error


def test_a_port_out_of_range_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["core", "-p", "99999"]) == 1
    assert "between 0 and 65535, got 99999" in capsys.readouterr().err


def test_logs_are_written_by_run_id(tmp_path: Path) -> None:
    with _core(logs=tmp_path) as (process, uri):
        run_id = MasterProxy(uri).call("getParam", "/run_id")
        MasterProxy(uri, "/me").call("setParam", "/speed", 3)
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0
    assert (tmp_path / "latest").resolve() == (tmp_path / run_id).resolve()
    assert "+PARAM [/speed] by /me\n" in (tmp_path / "latest/master.log").read_text()
    assert "Node Startup" in (tmp_path / "latest/rosout.log").read_text()


def test_the_master_runs_without_a_writable_log_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with _core(logs=tmp_path / "file") as (process, uri):
        assert MasterProxy(uri).call("getPid") == process.pid
        process.send_signal(signal.SIGTERM)
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "no logs are written: no log folder" in process.stderr.read()
