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
    """A node with options, and the values that it was set to."""
    node: Node = graph.node("camera")
    heard: list[Options] = []

    def apply(values: Options) -> Options:
        heard.append(values)
        return {**values, "rows": min(int(values["rows"]), 7)}  # a node may know better

    ReconfigureServer(node, OPTIONS, apply)
    graph.ready(node)
    return heard


def test_a_client_reads_what_a_server_offers(graph: Any, camera: list[Options]) -> None:
    client = graph.node("client")
    assert graph.loop.run(find_reconfigurable(client), PATIENCE_S) == ["/camera"]
    assert tuple(graph.loop.run(read_options(client, "camera"), PATIENCE_S)) == tuple(
        Option(name=o.name, value=o.value, description=o.description)
        if isinstance(o.value, bool | str)
        else o
        for o in OPTIONS
    )  # fmt: skip


def test_values_are_kept_within_bounds_told_and_written(graph: Any, camera: list[Options]) -> None:
    client = graph.node("client")
    told: list[Any] = []
    subscription = client.subscribe("/camera/parameter_updates", "dynamic_reconfigure/Config", told.append)
    graph.until(lambda: told and subscription.publishers)
    asked = {"rate": "99", "rows": 9, "on": "false", "frame": "head"}
    now = graph.loop.run(set_options(client, "/camera", asked), PATIENCE_S)

    assert camera == [{"rate": 50.0, "rows": 9, "on": False, "frame": "head"}]
    assert now == {"rate": 50.0, "rows": 7, "on": False, "frame": "head"}
    assert graph.loop.run(client.params.get("/camera"), PATIENCE_S) == now
    graph.until(lambda: [item.value for item in told[-1].doubles] == [50.0])


@pytest.mark.parametrize(
    ("values", "said"),
    [({"speed": 1}, "don't know parameter: speed; there are: rate"), ({"rows": "x"}, "is not of type int")],
)
def test_what_cannot_be_set_is_refused(graph: Any, camera: list[Options], values: Any, said: str) -> None:
    with pytest.raises(ServiceError, match=said):
        graph.loop.run(set_options(graph.node("client"), "camera", values), PATIENCE_S)
    assert camera == []


def test_a_server_heeds_what_it_can_of_a_careless_request(graph: Any, camera: list[Options]) -> None:
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
    package = tmp_path / "dynamic_reconfigure"  # Debian's has no manifest, which it looks for
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
