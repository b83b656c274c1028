"""`trundle service`, with rosservice's output."""

import io
import sys
from typing import Any

import pytest

from trundle.ros import ServiceError


@pytest.fixture
def server(graph: Any) -> Any:
    """A node with one service for each output format."""
    node = graph.node("server")

    def enable(request: Any) -> dict[str, Any]:
        if request.data:
            return {"success": True, "message": "on"}
        raise ServiceError("cannot be switched off")

    node.advertise_service("~enable", "std_srvs/SetBool", enable)
    node.advertise_service("~reset", "std_srvs/Empty", lambda _: {})
    node.advertise_service("/spawn", "turtlesim/Spawn", lambda r: {"name": f"{r.name}{r.x + r.y:g}"})
    node.advertise_service("/push", "gazebo_msgs/ApplyBodyWrench", lambda r: {"status_message": f"{r.wrench.force.x}"})
    graph.ready(node)
    return node


def test_services_are_listed(graph: Any, server: Any) -> None:
    assert graph.trundle("service", "list", "/server")[1] == (
        "/server/enable\n/server/get_loggers\n/server/reset\n/server/set_logger_level\n"
    )
    assert graph.trundle("service", "list", "-n", "/spawn") == (0, "/spawn /server\n", "")
    assert graph.trundle("service", "find", "turtlesim/Spawn")[1] == "/spawn\n"


def test_a_service_is_described(graph: Any, server: Any) -> None:
    uri = graph.trundle("service", "uri", "/spawn")[1]
    assert uri.startswith("rosrpc://127.0.0.1:")
    assert graph.trundle("service", "info", "/spawn")[1] == (
        f"Node: /server\nURI: {uri}Type: turtlesim/Spawn\nArgs: x y theta name\n"
    )
    assert graph.trundle("service", "type", "spawn")[1] == "turtlesim/Spawn\n"
    assert graph.trundle("service", "node", "/spawn")[1] == "/server\n"
    fields = "body_name reference_frame reference_point wrench start_time duration\n"
    assert graph.trundle("service", "args", "/push")[1] == fields


@pytest.mark.parametrize(
    ("arguments", "out"),
    [
        (["/server/reset"], "\n"),
        (["/server/enable", "true"], 'success: True\nmessage: "on"\n'),
        (["/spawn", "2", "-1.5", "0.2", ""], 'name: "0.5"\n'),
        (["/spawn", "{x: 1, name: t}"], 'name: "t1"\n'),
        (["-v", "/server/enable", "data: true"], 'data: True\n---\nsuccess: True\nmessage: "on"\n'),
        (["--wait", "/push", "{wrench: {force: {x: 2}}}"], 'success: False\nstatus_message: "2.0"\n'),
    ],
)
def test_a_service_is_called(graph: Any, server: Any, arguments: list[str], out: str) -> None:
    assert graph.trundle("service", "call", *arguments) == (0, out, "")


def test_requests_are_read_from_standard_input(graph: Any, server: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("{name: a}\n---\n[1, 2, 3, b]\n---\n"))
    assert graph.trundle("service", "call", "/spawn")[1] == 'name: "a0"\nname: "b3"\n'


def test_a_failed_call_is_an_error(graph: Any, server: Any) -> None:
    assert graph.trundle("service", "call", "/nope") == (2, "", "ERROR: Service [/nope] is not available.\n")
    assert graph.trundle("service", "info", "/nope") == (1, "", "ERROR: Unknown service: /nope\n")
    code, _, error = graph.trundle("service", "call", "/server/enable", "false")
    assert (code, error) == (
        2,
        "ERROR: service [/server/enable] responded with an error: service cannot process request: "
        "cannot be switched off\n",
    )
    code, _, error = graph.trundle("service", "call", "/spawn", "1", "2")
    assert code == 2
    assert error.endswith("Provided arguments are:\n * 1 (type int)\n * 2 (type int)\n\n"
                          "Service arguments are: [x y theta name]\n")  # fmt: skip


@pytest.mark.slow
@pytest.mark.real_ros
def test_output_is_equal_to_rosservice(graph: Any, server: Any, original: Any) -> None:
    for arguments in (
        ["list"],
        ["list", "-n", "/server"],
        ["info", "/server/enable"],
        ["type", "/server/reset"],
        ["uri", "/server/reset"],
        ["node", "/server/reset"],
        ["args", "/server/enable"],
        ["find", "std_srvs/SetBool"],
        ["call", "-v", "/server/enable", "true"],
        ["call", "/server/get_loggers"],
        ["call", "/server/reset"],
    ):
        assert graph.trundle("service", *arguments)[1] == original("rosservice", *arguments)
