"""Independent JavaScript client libraries in our graph: rosnodejs and @foxglove/ros1."""

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
FOXGLOVE = """
const { RosNode } = require('@foxglove/ros1');
const { TcpServerNode, TcpSocketNode } = require('@foxglove/ros1/nodejs');
const { HttpServerNodejs } = require('@foxglove/xmlrpc/nodejs');
async function main() {
  const node = new RosNode({
    name: '/fox', hostname: '127.0.0.1', pid: process.pid, rosMasterUri: process.env.ROS_MASTER_URI,
    httpServer: new HttpServerNodejs(), tcpSocketCreate: TcpSocketNode.Create,
    tcpServer: await TcpServerNode.Listen({ host: '127.0.0.1' }),
  });
  node.on('error', (error) => console.error(error));
  await node.start();
  await node.advertise({ topic: '/up', dataType: 'std_msgs/String', messageDefinitionText: 'string data' });
  const down = node.subscribe({ topic: '/down', dataType: 'std_msgs/String' });
  down.on('message', (message) => node.publish('/up', { data: 'heard ' + message.data }));
  node.on('paramUpdate', ({ key, value }) => { // what it sets itself is told, too
    if (key.startsWith('/for_js')) node.setParameter('/seen', key + ' = ' + value);
  });
  await node.setParameter('/from_js', await node.subscribeParam('/for_js'));
  const call = '<methodCall><methodName>setParam</methodName><params>' +
    ['/fox', '/fetched_js', 'yes'].map((text) => `<param><value>${text}</value></param>`).join('') +
    '</params></methodCall>';
  const headers = { 'Content-Type': 'text/xml' };
  await fetch(process.env.ROS_MASTER_URI, { method: 'POST', headers, body: call });
  await node.setParameter('/names', (await node.getParamNames()).filter((name) => name.endsWith('_js')));
}
main().catch((error) => { console.error(error); process.exit(1); });
"""


def _share(folder: Path, messages: Messages) -> None:
    """Write message packages in the form of an installed ROS."""
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


def _node_with(library: str, monkeypatch: pytest.MonkeyPatch) -> str:
    if "NODE_PATH" not in os.environ:
        monkeypatch.setenv("NODE_PATH", str(Path(__file__).parents[2] / ".npm/node_modules"))
    program = shutil.which("node")
    if (
        program is None
        or subprocess.run([program, "-e", f"require.resolve({library!r})"], capture_output=True).returncode
    ):
        pytest.skip(f"node finds no {library} (make system installs it; NODE_PATH says where else it is)")
    return program


def test_topics_services_and_parameters_work_both_ways(
    graph: Any, messages: Messages, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    node_js = _node_with("rosnodejs", monkeypatch)
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

            def is_echoed() -> bool:
                down.publish({"data": "hello"})
                return "heard hello" in got

            graph.until(is_echoed)
            graph.until(lambda: graph.loop.run(node.params.get("/from_js", None)) == 7)
        finally:
            client.kill()


def test_the_library_of_foxglove_publishes_subscribes_and_watches_parameters(
    graph: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its requests come from node-fetch; one of Node's `fetch`, with a browser's header fields, is served, too."""
    node_js = _node_with("@foxglove/ros1", monkeypatch)
    node = graph.node("ours")
    got: list[str] = []
    node.subscribe("/up", "std_msgs/String", lambda m: got.append(m.data))
    down = node.advertise("/down", "std_msgs/String")
    graph.loop.run(node.params.set("/for_js", [1, "two", True]), PATIENCE_S)

    def value(name: str) -> Any:
        return graph.loop.run(node.params.get(name, None), PATIENCE_S)

    with subprocess.Popen([node_js, "-e", FOXGLOVE], env={**os.environ, "ROS_MASTER_URI": graph.core.uri}) as client:
        try:

            def is_echoed() -> bool:
                assert client.poll() is None, "the client ended"
                down.publish({"data": "hello"})
                return "heard hello" in got

            graph.until(is_echoed)
            graph.until(lambda: value("/names") is not None)
            assert sorted(value("/names")) == ["/fetched_js", "/for_js", "/from_js"]
            assert (value("/from_js"), value("/fetched_js")) == ([1, "two", True], "yes")
            graph.loop.run(node.params.set("/for_js", "later"), PATIENCE_S)
            graph.until(lambda: value("/seen") == "/for_js = later")
        finally:
            client.kill()
