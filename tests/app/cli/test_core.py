"""`trundle core`: starts, answers, and stops."""

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
def test_it_answers_until_it_is_stopped(number: signal.Signals, tmp_path: Path) -> None:
    with _core(logs=tmp_path) as (process, uri):
        assert MasterProxy(uri).call("getSystemState")[0] == [["/rosout_agg", ["/rosout"]]]
        process.send_signal(number)
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "Traceback" not in process.stderr.read()


def test_a_job_in_a_scripts_background_hears_sigint_too(tmp_path: Path) -> None:
    """`roscore & … kill -INT $!`: such a shell has its jobs ignore it."""
    with _core(logs=tmp_path, shell=["sh", "-c", "trap '' INT; exec \"$@\"", "sh"]) as (process, _):
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0


def test_a_shutdown_request_ends_it(tmp_path: Path) -> None:
    switches = ("-w", "3", "-t", "3", "--sigint-timeout=9", "--sigterm-timeout=2")
    with _core("--distro", "indigo", *switches, logs=tmp_path) as (process, uri):
        assert MasterProxy(uri).call("getParam", "/rosdistro") == "indigo\n"
        MasterProxy(uri, "/me").call("shutdown", "enough")
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "external shutdown request from [/me]: enough" in process.stderr.read()


def test_listening_beyond_this_machine_is_warned_of(tmp_path: Path) -> None:
    with _core("--host", "0.0.0.0", logs=tmp_path) as (process, _):
        process.send_signal(signal.SIGTERM)
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "listening on 0.0.0.0: ROS 1 has no passwords" in process.stderr.read()


def test_an_address_that_leads_elsewhere_is_one_sentence(capfd: pytest.CaptureFixture[str], monkeypatch: Any) -> None:
    """192.0.2.1 is unassigned (RFC 5737): nothing answers there."""
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
def test_a_master_uri_that_names_another_is_warned_of(graph: Any, monkeypatch: Any, uri: str, warning: str) -> None:
    """On a port that is taken, so that it ends at once."""
    monkeypatch.setattr("signal.signal", lambda *_: None)
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    _, _, error = graph.trundle("core", "-p", str(graph.core.port))
    assert f"WARNING: {warning.format(port=graph.core.port)}" in error


def test_a_master_uri_that_names_this_one_is_fine(graph: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr("signal.signal", lambda *_: None)
    monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{graph.core.port}/")
    assert "WARNING" not in graph.trundle("core", "-p", str(graph.core.port))[2]


def test_rosout_comes_back_after_it_was_killed(graph: Any) -> None:
    heard: list[Any] = []
    node = graph.node("listener")
    node.subscribe("/rosout_agg", "rosgraph_msgs/Log", heard.append, queue_size=None)
    graph.ready(node)
    before = MasterProxy(graph.core.uri).call("lookupNode", "/rosout")
    assert graph.trundle("node", "kill", "/rosout")[0] == 0

    def is_new() -> bool:
        try:
            return MasterProxy(graph.core.uri).call("lookupNode", "/rosout") != before
        except MasterError:  # the old master has gone, the new one is not up yet
            return False

    graph.until(is_new)
    graph.until(lambda: node.log.info("hello") or any(message.msg == "hello" for message in heard))


def test_a_distribution_that_is_none_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["core", "--distro", "ardent"]) == 2
    assert "indigo" in capsys.readouterr().err


def test_a_taken_port_is_one_sentence(graph: Any) -> None:
    code, out, error = graph.trundle("core", "-p", str(graph.core.port))
    assert (code, out) == (1, "")
    assert error.count("\n") == 1
    assert f"port {graph.core.port} on 127.0.0.1 is taken" in error
    assert "-p PORT" in error


def test_a_port_that_is_none_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["core", "-p", "99999"]) == 1
    assert "between 0 and 65535, got 99999" in capsys.readouterr().err


def test_it_keeps_logs_of_its_run(tmp_path: Path) -> None:
    with _core(logs=tmp_path) as (process, uri):
        run_id = MasterProxy(uri).call("getParam", "/run_id")
        MasterProxy(uri, "/me").call("setParam", "/speed", 3)
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0
    assert (tmp_path / "latest").resolve() == (tmp_path / run_id).resolve()
    assert "+PARAM [/speed] by /me\n" in (tmp_path / "latest/master.log").read_text()
    assert "Node Startup" in (tmp_path / "latest/rosout.log").read_text()


def test_it_runs_where_logs_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with _core(logs=tmp_path / "file") as (process, uri):
        assert MasterProxy(uri).call("getPid") == process.pid
        process.send_signal(signal.SIGTERM)
        assert process.wait(20) == 0
        assert process.stderr is not None
        assert "no logs are written: no log folder" in process.stderr.read()
