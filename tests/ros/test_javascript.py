"""An independent client library of another language joins: rosnodejs, whose author read the same wire."""

import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros import Messages

pytestmark = pytest.mark.slow
CLIENT = """
const ros = require('rosnodejs');
ros.initNode('/js', {onTheFly: true}).then((node) => {
  const text = ros.require('std_msgs').msg.String;
  const up = node.advertise('/up', text);
  node.subscribe('/down', text, (message) => up.publish({data: 'heard ' + message.data}));
  node.advertiseService('/js/set', ros.require('std_srvs').srv.SetBool, (request, response) => {
    response.success = request.data;
    response.message = 'from JavaScript';
    return true;
  });
  return node.setParam('/from_js', 7);
});
"""


def _share(folder: Path, messages: Messages) -> None:
    """Message packages as an installed ROS has them."""
    for package in ("std_msgs", "rosgraph_msgs", "std_srvs", "roscpp"):
        home = folder / package
        (home / "msg").mkdir(parents=True)
        (home / "srv").mkdir()
        (home / "package.xml").write_text(f"<package><name>{package}</name><version>1.0.0</version></package>")
        for name in messages.type_names():
            if name.startswith(f"{package}/"):
                (home / "msg" / f"{name.partition('/')[2]}.msg").write_text(messages.text(name))
        for name in messages.service_names():
            if name.startswith(f"{package}/"):
                (home / "srv" / f"{name.partition('/')[2]}.srv").write_text(messages.service_text(name))


@pytest.fixture
def node_js(monkeypatch: pytest.MonkeyPatch) -> str:
    if "NODE_PATH" not in os.environ:
        monkeypatch.setenv("NODE_PATH", str(Path(__file__).parents[2] / ".npm/node_modules"))
    program = shutil.which("node")
    if (
        program is None
        or subprocess.run([program, "-e", "require.resolve('rosnodejs')"], capture_output=True).returncode
    ):
        pytest.skip("node finds no rosnodejs (make system installs it; NODE_PATH says where else it is)")
    return program


def test_topics_services_and_parameters_work_both_ways(
    graph: Any, messages: Messages, tmp_path: Path, node_js: str
) -> None:
    share = tmp_path / "share"
    _share(share, messages)
    env = {**os.environ, "ROS_MASTER_URI": graph.core.uri, "ROS_IP": "127.0.0.1"}
    env |= {"CMAKE_PREFIX_PATH": str(tmp_path), "ROS_PACKAGE_PATH": str(share), "ROS_ROOT": str(share)}
    node = graph.node("ours")
    got: list[str] = []
    node.subscribe("/up", "std_msgs/String", lambda m: got.append(m.data))
    down = node.advertise("/down", "std_msgs/String")
    with subprocess.Popen([node_js, "-e", CLIENT], env=env, cwd=tmp_path, stdout=subprocess.DEVNULL) as client:
        try:
            graph.loop.run(node.wait_for_service("/js/set", PATIENCE_S), PATIENCE_S)
            answer = graph.loop.run(node.call_service("/js/set", "std_srvs/SetBool", {"data": True}), PATIENCE_S)
            assert (answer.success, answer.message) == (True, "from JavaScript")

            def heard() -> bool:
                down.publish({"data": "hello"})
                return "heard hello" in got

            graph.until(heard)
            graph.until(lambda: graph.loop.run(node.get_param("/from_js", None)) == 7)
        finally:
            client.kill()
