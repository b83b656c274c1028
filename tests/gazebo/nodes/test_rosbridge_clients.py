"""The usual rosbridge clients: npm's roslib and PyPI's roslibpy."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.gazebo.nodes.bridge_client import port_of

ROOT = Path(__file__).parents[3]
PIP = ROOT / ".pip"
EXPECTED = {
    "received": [1.5, "eye", 2],
    "services": True,
    "type": "geometry_msgs/PoseStamped",
    "sum": 5,
    "provided": 8,
    "param": [1, {"a": "b"}],
    "image": "AAEC",
    "failed": True,
}
"""What each client prints."""

ROSLIB = """
const ROSLIB = require('roslib');
const ros = new ROSLIB.Ros({ url: process.argv[1] });
const later = (start) => new Promise((resolve, reject) => start(resolve, reject));
const service = (name, serviceType) => new ROSLIB.Service({ ros, name, serviceType });
const topic = (name, messageType, more) => new ROSLIB.Topic({ ros, name, messageType, ...more });
async function main() {
  await later((resolve) => ros.on('connection', resolve));
  const results = {};
  const pose = topic('/pose', 'geometry_msgs/PoseStamped');
  const received = later((resolve) => pose.subscribe(resolve));
  const again = topic('/pose', 'geometry_msgs/PoseStamped', { latch: true });
  again.publish(new ROSLIB.Message({ header: { frame_id: 'eye', stamp: { secs: 2, nsecs: 0 } },
                                     pose: { position: { x: 1.5 } } }));
  const message = await received;
  results.received = [message.pose.position.x, message.header.frame_id, message.header.stamp.secs];
  results.services = (await later((resolve, reject) => ros.getServices(resolve, reject))).includes('/add');
  results.type = await later((resolve, reject) => ros.getTopicType('/pose', resolve, reject));
  const sum = await later((resolve, reject) => service('/add', 'rospy_tutorials/AddTwoInts').callService(
    new ROSLIB.ServiceRequest({ a: 2, b: 3 }), resolve, reject));
  results.sum = sum.sum;
  const twice = service('/twice', 'rospy_tutorials/AddTwoInts');
  twice.advertise((request, response) => { response.sum = 2 * request.a; return true; });
  while (!(await later((resolve, reject) => ros.getServices(resolve, reject))).includes('/twice'));
  const provided = await later((resolve, reject) => service('/twice', 'rospy_tutorials/AddTwoInts').callService(
    new ROSLIB.ServiceRequest({ a: 4 }), resolve, reject));
  results.provided = provided.sum;
  const param = new ROSLIB.Param({ ros, name: '/of/js' });
  await later((resolve) => param.set([1, { a: 'b' }], resolve));
  results.param = await later((resolve) => param.get(resolve));
  const image = topic('/image', 'sensor_msgs/Image', { compression: 'png' });
  results.image = (await later((resolve) => image.subscribe(resolve))).data;
  results.failed = await later((resolve) => service('/no', 'std_srvs/Empty').callService(
    new ROSLIB.ServiceRequest({}), () => resolve(false), () => resolve(true)));
  console.log(JSON.stringify(results));
  process.exit(0);
}
main();
"""
ROSLIBPY = """
import json, sys, threading
import roslibpy
ros = roslibpy.Ros(sys.argv[1])
ros.run(timeout=60)
results = {}
def first(name, kind, **options):
    box, event = [], threading.Event()
    topic = roslibpy.Topic(ros, name, kind, **options)
    topic.subscribe(lambda message: (box.append(message), event.set()))
    return lambda: event.wait(60) and box[0]
received = first('/pose', 'geometry_msgs/PoseStamped')
pose = roslibpy.Topic(ros, '/pose', 'geometry_msgs/PoseStamped', latch=True)
pose.publish(roslibpy.Message({'header': {'frame_id': 'eye', 'stamp': {'secs': 2, 'nsecs': 0}},
                               'pose': {'position': {'x': 1.5}}}))
message = received()
header = message['header']
results['received'] = [message['pose']['position']['x'], header['frame_id'], header['stamp']['secs']]
results['services'] = '/add' in ros.get_services()
results['type'] = ros.get_topic_type('/pose')
add = roslibpy.Service(ros, '/add', 'rospy_tutorials/AddTwoInts')
results['sum'] = add.call(roslibpy.ServiceRequest({'a': 2, 'b': 3}), timeout=60)['sum']
twice = roslibpy.Service(ros, '/twice', 'rospy_tutorials/AddTwoInts')
def double(request, response):
    response['sum'] = 2 * request['a']
    return True
twice.advertise(double)
while '/twice' not in ros.get_services():
    pass
caller = roslibpy.Service(ros, '/twice', 'rospy_tutorials/AddTwoInts')
results['provided'] = caller.call(roslibpy.ServiceRequest({'a': 4}), timeout=60)['sum']
param = roslibpy.Param(ros, '/of/py')
param.set([1, {'a': 'b'}])
results['param'] = param.get()
results['image'] = first('/image', 'sensor_msgs/Image')()['data']
try:
    roslibpy.Service(ros, '/no', 'std_srvs/Empty').call(roslibpy.ServiceRequest(), timeout=60)
except Exception:
    results['failed'] = True
print(json.dumps(results), flush=True)
ros.terminate()
"""


@pytest.fixture
def url(graph) -> str:
    graph.client.advertise_service("/add", "rospy_tutorials/AddTwoInts", lambda request: {"sum": request.a + request.b})
    graph.client.advertise("/image", "sensor_msgs/Image", latch=True).publish({"data": b"\0\1\2"})
    graph.start("rosapi/rosapi_node", name="rosapi")
    graph.start("rosbridge_server/rosbridge_websocket", port=0)
    port = port_of(graph, "rosbridge_websocket")
    graph.loop.run(graph.client.wait_for_service("/rosapi/get_time", 60.0))
    graph.loop.run(graph.client.wait_registered())
    return f"ws://127.0.0.1:{port}"


def _run(command: list[str], environment: dict[str, str]) -> object:
    done = subprocess.run(
        command, env=os.environ | environment, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.stdout, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.slow
def test_roslib_of_npm(url: str) -> None:
    modules = os.environ.get("NODE_PATH") or str(ROOT / ".npm/node_modules")
    node = shutil.which("node")
    if node is None or not (Path(modules) / "roslib").is_dir():
        pytest.skip("no Node or no roslib (make system installs it; NODE_PATH says where else it is)")

    assert _run([node, "-e", ROSLIB, "--", url], {"NODE_PATH": modules}) == EXPECTED


@pytest.mark.slow
def test_roslibpy(url: str) -> None:
    if not (PIP / "roslibpy").is_dir():
        pytest.skip("no roslibpy (make system installs it)")

    assert _run([sys.executable, "-c", ROSLIBPY, url], {"PYTHONPATH": str(PIP)}) == EXPECTED
