"""dynamic_reconfigure: our server against our client, and against Debian's dynparam."""

import subprocess
from pathlib import Path
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros import (
    Node,
    Option,
    Options,
    ReconfigureServer,
    ServiceError,
    find_reconfigurable,
    read_options,
    set_options,
)

OPTIONS = (
    Option(name="rate", value=10.0, lower=1.0, upper=50.0, description="[Hz]"),
    Option(name="rows", value=3, lower=1, upper=9),
    Option(name="on", value=True),
    Option(name="frame", value="base"),
)
_MANIFEST = """<package><name>dynamic_reconfigure</name><version>1.7.3</version><description>d</description>
<maintainer email="m@example.com">m</maintainer><license>x</license></package>"""
DYNPARAM = Path("/usr/lib/dynamic_reconfigure/dynparam")


@pytest.fixture
def camera(graph: Any) -> list[Options]:
    """A node with options; the values that were set on it."""
    node: Node = graph.node("camera")
    received: list[Options] = []

    def apply(values: Options) -> Options:
        received.append(values)
        return {**values, "rows": min(int(values["rows"]), 7)}  # a node may change values

    ReconfigureServer(node, OPTIONS, apply)
    graph.ready(node)
    return received


def test_a_client_reads_the_options_of_a_server(graph: Any, camera: list[Options]) -> None:
    client = graph.node("client")
    assert graph.loop.run(find_reconfigurable(client), PATIENCE_S) == ["/camera"]
    assert tuple(graph.loop.run(read_options(client, "camera"), PATIENCE_S)) == tuple(
        Option(name=o.name, value=o.value, description=o.description)
        if isinstance(o.value, bool | str)
        else o
        for o in OPTIONS
    )  # fmt: skip


def test_set_values_are_clamped_published_and_stored_as_parameters(graph: Any, camera: list[Options]) -> None:
    client = graph.node("client")
    updates: list[Any] = []
    subscription = client.subscribe("/camera/parameter_updates", "dynamic_reconfigure/Config", updates.append)
    graph.until(lambda: updates and subscription.publishers)
    requested = {"rate": "99", "rows": 9, "on": "false", "frame": "head"}
    values = graph.loop.run(set_options(client, "/camera", requested), PATIENCE_S)

    assert camera == [{"rate": 50.0, "rows": 9, "on": False, "frame": "head"}]
    assert values == {"rate": 50.0, "rows": 7, "on": False, "frame": "head"}
    assert graph.loop.run(client.params.get("/camera"), PATIENCE_S) == values
    graph.until(lambda: [item.value for item in updates[-1].doubles] == [50.0])


@pytest.mark.parametrize(
    ("values", "reason"),
    [({"speed": 1}, "don't know parameter: speed; there are: rate"), ({"rows": "x"}, "is not of type int")],
)
def test_unknown_options_and_invalid_values_are_refused(
    graph: Any, camera: list[Options], values: Any, reason: str
) -> None:
    with pytest.raises(ServiceError, match=reason):
        graph.loop.run(set_options(graph.node("client"), "camera", values), PATIENCE_S)
    assert camera == []


def test_valid_values_of_a_partly_invalid_request_are_set(graph: Any, camera: list[Options]) -> None:
    client = graph.node("client")
    graph.loop.run(client.wait_for_service("/camera/set_parameters"), PATIENCE_S)
    config = {"doubles": [{"name": "rate", "value": float("nan")}, {"name": "x", "value": 1.0}], "ints": []}
    config["ints"] = [{"name": "rows", "value": 5}]
    kind = "dynamic_reconfigure/Reconfigure"
    graph.loop.run(client.call_service("/camera/set_parameters", kind, {"config": config}), PATIENCE_S)
    assert camera == [{"rate": 10.0, "rows": 5, "on": True, "frame": "base"}]


@pytest.mark.real_ros
@pytest.mark.slow
def test_the_real_dynparam_lists_gets_and_sets(graph: Any, camera: list[Options], tmp_path: Path) -> None:
    if not DYNPARAM.exists():
        pytest.skip("Debian's dynamic_reconfigure is not installed")
    package = tmp_path / "dynamic_reconfigure"  # Debian's has no manifest, which dynparam requires
    package.mkdir()
    (package / "package.xml").write_text(_MANIFEST)
    env = {
        "ROS_PACKAGE_PATH": str(tmp_path),
        "PATH": "/usr/bin:/bin",
        "HOME": str(tmp_path),
        "ROS_MASTER_URI": graph.core.uri,
        "ROS_IP": "127.0.0.1",
    }

    def dynparam(*words: str) -> str:
        command = ["/usr/bin/python3", "-W", "ignore", str(DYNPARAM), *words]
        done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=100.0, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert dynparam("list") == "/camera\n"
    dynparam("set", "camera", "{rate: 20, frame: head}")
    assert camera[-1] == {"rate": 20.0, "rows": 3, "on": True, "frame": "head"}
    got = dynparam("get", "camera")
    assert "'rate': 20.0" in got
    assert "'on': True" in got
