"""Topics of all types of sensors, as listed in docs/sensors.md."""

import re
import threading
from pathlib import Path

import pytest

from trundle.ros import GraphLoop, Node
from trundle.sim.sensors import SIMULATED_CAMERAS

DOCS = Path(__file__).parents[2] / "docs/sensors.md"
WITHOUT_TOPIC = {"rfidtag", "wireless_transmitter"}
_SMALL = "<image><width>16</width><height>12</height></image><clip><near>0.1</near><far>20</far></clip>"
_SCAN = "<scan><horizontal><samples>5</samples></horizontal></scan><range><min>0.1</min><max>9</max></range>"
_INSIDE = {
    "multicamera": f'<camera name="left">{_SMALL}</camera>',
    "logical_camera": "<logical_camera><near>0.1</near><far>9</far></logical_camera>",
    "sonar": "<sonar><min>0.1</min><max>5</max><radius>0.5</radius></sonar>",
    "contact": "<contact><collision>c</collision></contact>",
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar"), f"<ray>{_SCAN}</ray>"),
}
_CAMERAS = [type_ for type_ in SIMULATED_CAMERAS if "camera" in type_] + [
    *("depth", "rgbd", "segmentation", "boundingbox", "thermal")
]


def documented() -> dict[str, dict[str, str]]:
    """Return the topics and messages of each type of sensor."""
    table: dict[str, dict[str, str]] = {}
    types: list[str] = []
    for row in re.findall(r"^\| (.*) \| `(.*)` \| `(.*)` \|$", DOCS.read_text(), re.MULTILINE):
        types = re.findall(r"`(\w+)`", row[0]) or types
        for type_ in types:
            table.setdefault(type_, {})[row[1].replace("<camera>", "left")] = row[2]
    return table


def world() -> str:
    """Return a world with one sensor of each type, with the type's name, on a box on the ground."""

    def sensor(type_: str) -> str:
        inside = _INSIDE.get(type_) or (f"<camera>{_SMALL}</camera>" if type_ in _CAMERAS else "")
        return f'<sensor name="{type_}" type="{type_}"><update_rate>20</update_rate>{inside}</sensor>'

    on_link = "".join(sensor(type_) for type_ in sorted(SIMULATED_CAMERAS - {"force_torque"}))
    collision = '<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>'
    return f"""<sdf version="1.9"><world name="w"><spherical_coordinates/>
        <include><uri>model://sun</uri></include><include><uri>model://ground_plane</uri></include>
        <model name="m"><pose>0 0 0.5 0 0 0</pose><link name="l">{collision}{on_link}</link>
        <link name="k"><pose>0 0 0.6 0 0 0</pose></link>
        <joint name="j" type="fixed"><parent>l</parent><child>k</child>{sensor("force_torque")}</joint></model>
        <model name="post"><static>1</static><pose>3 0 0.5 0 0 0</pose><link name="l">{collision}</link></model>
        </world></sdf>"""


def test_the_table_names_every_sensor() -> None:
    assert set(documented()) == SIMULATED_CAMERAS - WITHOUT_TOPIC


@pytest.mark.slow
def test_every_documented_topic_has_messages_in_a_known_frame(start, master, until, env, tmp_path) -> None:
    file = tmp_path / "w.sdf"
    file.write_text(world())
    expected_topics = {
        f"/m/{'j' if type_ == 'force_torque' else 'l'}/{type_}/{topic}": message
        for type_, topics in documented().items()
        for topic, message in topics.items()
    }
    start("run", str(file), "--headless", "--speed", "max")
    until("the topics", lambda: expected_topics.items() <= dict(master.call("getTopicTypes")).items())

    frame_ids: dict[str, str] = {}
    frames: set[str] = {"world"}
    all_received = threading.Event()

    def receive(topic: str, message) -> None:
        first = message.transforms[0] if topic.endswith("/models") else message
        frame_ids[topic] = first.header.frame_id
        if frame_ids.keys() == expected_topics.keys():
            all_received.set()

    with GraphLoop() as loop:
        node = Node("/listener", loop=loop, master_uri=env["ROS_MASTER_URI"], rosout=False)
        for topic in ("/tf", "/tf_static"):
            node.subscribe(topic, "tf2_msgs/TFMessage", lambda m: frames.update(t.child_frame_id for t in m.transforms))
        for topic, message in expected_topics.items():
            node.subscribe(topic, message, lambda message, topic=topic: receive(topic, message))
        assert all_received.wait(60), f"nothing came on {sorted(expected_topics.keys() - frame_ids.keys())}"
        until("the frames", lambda: set(frame_ids.values()) <= frames)
