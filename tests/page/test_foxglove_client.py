"""Foxglove's client library for JavaScript: topics, services, parameters, the graph, files."""

import json
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

CLIENT = """
const { FoxgloveClient } = require('@foxglove/ws-protocol');
const WebSocket = require('ws');
const socket = new WebSocket(process.env.PAGE_URL, [process.env.SUBPROTOCOL]);
const client = new FoxgloveClient({ ws: socket });
const text = (data) => Buffer.from(data.buffer, data.byteOffset, data.byteLength);
const said = (data) => text(data).subarray(4).toString();
const encoded = (string) => {
  const bytes = Buffer.alloc(4 + string.length);
  bytes.writeUInt32LE(string.length);
  bytes.write(string, 4);
  return new Uint8Array(bytes);
};
const report = (name, value) => console.log(JSON.stringify([name, value]));
const topics = new Map();
let up;
client.on('error', (error) => report('error', String(error)));
client.on('status', (status) => report('status', status.message));
client.on('serverInfo', (info) => {
  report('serverInfo', [socket.protocol, info.capabilities, info.supportedEncodings]);
  up = client.advertise({ topic: '/up', encoding: 'ros1', schemaName: 'std_msgs/String' });
  client.subscribeConnectionGraph();
  client.subscribeParameterUpdates(['/watched']);
  client.setParameters([{ name: '/from_js', value: 7 }], 'set');
  client.getParameters(['/for_js'], 'get');
  client.fetchAsset('package://robot/meshes/box.stl', 1);
  client.fetchAsset('file:///etc/passwd', 2);
});
client.on('advertise', (channels) => {
  for (const channel of channels) {
    if (channel.topic === '/down') {
      report('channel', channel);
      topics.set(client.subscribe(channel.id), channel.topic);
    }
  }
});
client.on('unadvertise', () => report('unadvertise', null));
client.on('message', ({ subscriptionId, timestamp, data }) => {
  report('message', [topics.get(subscriptionId), said(data), timestamp > 10n ** 18n]);
  client.sendMessage(up, encoded('heard ' + said(data)));
});
let timed = false;
client.on('time', () => { if (!timed) report('time', null); timed = true; });
client.on('parameterValues', (values) => report('parameters', [values.id ?? null, values.parameters]));
client.on('advertiseServices', (services) => {
  for (const service of services) {
    if (service.name === '/set') {
      const data = new DataView(new Uint8Array([1]).buffer);
      client.sendServiceCallRequest({ serviceId: service.id, callId: 5, encoding: 'ros1', data });
    }
    if (service.name === '/fail') {
      const data = new DataView(new ArrayBuffer(0));
      client.sendServiceCallRequest({ serviceId: service.id, callId: 6, encoding: 'ros1', data });
    }
  }
});
client.on('serviceCallResponse', (r) => report('service', [r.callId, r.encoding, text(r.data).toString('hex')]));
client.on('serviceCallFailure', (failure) => report('failure', [failure.callId, failure.message]));
client.on('connectionGraphUpdate', (update) => report('graph', update));
client.on('fetchAssetResponse', (r) => report('asset', r.status === 0 ? text(r.data).toString() : r.error));
"""


def _node() -> tuple[str, dict[str, str]]:
    environment = {"NODE_PATH": str(Path(__file__).parents[2] / ".npm/node_modules")} | os.environ
    program = shutil.which("node")
    program_text = "require.resolve('@foxglove/ws-protocol'); require.resolve('ws')"
    if (
        program is None
        or subprocess.run([program, "-e", program_text], capture_output=True, env=environment).returncode
    ):
        pytest.skip("node finds no @foxglove/ws-protocol (make system installs it; NODE_PATH says where else it is)")
    return program, environment


@pytest.mark.parametrize("subprotocol", ["foxglove.websocket.v1", "foxglove.sdk.v1"])
def test_foxgloves_client_uses_all_of_the_protocol(subprotocol: str, tmp_path: Path) -> None:
    program, environment = _node()
    (tmp_path / "robot/meshes").mkdir(parents=True)
    (tmp_path / "robot/package.xml").write_text("<package><name>robot</name></package>")
    (tmp_path / "robot/meshes/box.stl").write_text("solid box")
    (tmp_path / "robot/robot.urdf").write_text("<robot name='r'/>")
    with running_graph() as graph:
        node = graph.node("ours")
        down = node.advertise("/down", "std_msgs/String")
        received: list[str] = []
        node.subscribe("/up", "std_msgs/String", lambda m: received.append(m.data))
        node.advertise_service("/set", "std_srvs/SetBool", lambda r: {"success": r.data, "message": "ok"})
        node.advertise_service("/fail", "std_srvs/Empty", lambda _: 1 / 0)
        graph.loop.run(node.params.set("/for_js", 2.0))
        graph.ready(node)
        with PageServer.start(
            Session(title="t", kind="graph"),
            at=PageAddress(port=0),
            graph=GraphAddress(master_uri=graph.core.uri),
            source=tmp_path / "robot/robot.urdf",
        ) as page:
            environment |= {"PAGE_URL": page.foxglove_url, "SUBPROTOCOL": subprotocol}
            client = subprocess.Popen([program, "-e", CLIENT], env=environment, stdout=subprocess.PIPE, text=True)
            try:

                def answered() -> bool:
                    down.publish({"data": "hello"})
                    return "heard hello" in received

                graph.until(answered)
                graph.loop.run(node.params.set("/watched", [1.5, 2.0]))
                reports = _read(client, ("failure", "service", "asset", "parameters:null", "time", "graph"))
                assert graph.loop.run(node.params.get("/from_js")) == 7
            finally:
                client.kill()
                client.wait()
                assert client.stdout is not None
                client.stdout.close()

    assert not [value for name, value in reports if name in ("error", "status")]
    by_name = {name: value for name, value in reports if name != "parameters"}
    assert by_name["serverInfo"][0] == subprotocol
    assert set(by_name["serverInfo"][1]) == {
        "clientPublish", "parameters", "parametersSubscribe", "services", "connectionGraph", "assets", "time",
    }  # fmt: skip
    assert by_name["serverInfo"][2] == ["ros1"]
    assert "string data" in by_name["channel"]["schema"]
    assert by_name["message"] == ["/down", "hello", True]
    assert by_name["service"] == [5, "ros1", b"\1\2\0\0\0ok".hex()]
    assert by_name["failure"][0] == 6
    assert any({"name": "/down", "publisherIds": ["/ours"]} in v["publishedTopics"] for n, v in reports if n == "graph")
    assets = [value for name, value in reports if name == "asset"]
    assert assets[0] == "solid box"
    assert "leads to /etc/passwd" in assets[1]
    parameters = [value for name, value in reports if name == "parameters"]
    assert ["set", [{"name": "/from_js", "value": 7}]] in parameters
    assert ["get", [{"name": "/for_js", "value": 2, "type": "float64"}]] in parameters
    assert [None, [{"name": "/watched", "value": [1.5, 2], "type": "float64_array"}]] in parameters


def _read(client: "subprocess.Popen[str]", names: tuple[str, ...]) -> list[tuple[str, Any]]:
    """Read the client's reports until there is one of each name; `parameters:null` is an update of parameters."""
    assert client.stdout is not None
    reports: list[tuple[str, Any]] = []
    missing, assets = set(names), 0
    while missing or assets < 2:
        line = client.stdout.readline()
        assert line, f"the client ended without {missing}"
        name, value = json.loads(line)
        reports.append((name, value))
        missing -= {name, "parameters:null" if name == "parameters" and value[0] is None else name}
        assets += name == "asset"
    return reports
