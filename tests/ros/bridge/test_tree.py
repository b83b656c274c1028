"""The frame of each sensor type's messages is in tf, at the sensor's pose, on every kind of mount."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import trundle
from trundle.ros import Transform, TransformBuffer
from trundle.ros.bridge import FrameNames, LinkTransforms, make_camera_topics, make_sensor_topics
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import (
    SIMULATED_CAMERAS,
    CameraSensor,
    ForceTorqueSensor,
    SonarSensor,
    mount_cameras,
    mount_sensors,
)
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Pose, Twist, quaternion_from_rpy

MASS = "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
SMALL = "<camera><pose>0.1 0 0 0 0 0.2</pose><image><width>8</width><height>6</height></image></camera>"
SCAN = "<ray><scan><horizontal><samples>3</samples></horizontal></scan><range><max>5</max></range></ray>"
WIDE = "<logical_camera><far>90</far><horizontal_fov>3</horizontal_fov></logical_camera>"
SETTINGS = {"ray": SCAN, "gpu_ray": SCAN, "lidar": SCAN, "gpu_lidar": SCAN, "logical_camera": WIDE}
EXCLUDED = ("force_torque", "rfidtag", "wireless_transmitter")
"""Sensors without a link frame or without messages."""
OPTICAL = Pose(quaternion=quaternion_from_rpy(-1.5707963267948966, 0.0, -1.5707963267948966))


class FakeNode:
    """Stand-in for a node that records the frames of messages, and tf."""

    def __init__(self) -> None:
        self.tree = TransformBuffer()
        self.frame_ids: dict[str, str] = {}
        """Topic → frame_id of its messages."""

    def advertise(self, topic: str, type_: str, **_: Any) -> Any:
        is_tf = topic.startswith("/tf")

        def publish(message: Any) -> None:
            for item in message.get("transforms", [message]):
                if is_tf:
                    t, q = item["transform"]["translation"], item["transform"]["rotation"]
                    pose = (t["x"], t["y"], t["z"]), (q["w"], q["x"], q["y"], q["z"])
                    self.add_transform(
                        item["header"]["frame_id"], item["child_frame_id"], item["header"]["stamp"], *pose
                    )
                else:
                    self.frame_ids[topic] = item["header"]["frame_id"]

        return SimpleNamespace(topic=topic, type=type_, publish=publish, has_subscribers=True)

    def add_transform(self, parent: str, child: str, stamp: int, translation: Any, rotation: Any) -> None:
        assert self.tree.frames().get(child) in (None, parent), f"{child} has two parents"
        transform = Transform(parent=parent, child=child, stamp_ns=stamp, translation=translation, rotation=rotation)
        self.tree.set_transform(transform, static=stamp == 0)

    def send_transform(self, *transforms: Transform) -> None:
        """Stand in for the static broadcaster."""
        for transform in transforms:
            self.add_transform(transform.parent, transform.child, 0, transform.translation, transform.rotation)

    def new(self, type_: str, message: Any) -> Any:
        del type_
        return message


def sensors(types: list[str]) -> str:
    def one(type_: str) -> str:
        inside = SETTINGS.get(type_, SMALL if "cam" in type_ or type_ in CAMERA_TYPES else "")
        rate = "<pose>0.3 0.2 0.1 0.4 0.5 0.6</pose><always_on>1</always_on><update_rate>100</update_rate>"
        return f'<sensor name="{type_}" type="{type_}">{rate}{inside}</sensor>'

    return "".join(one(type_) for type_ in types)


CAMERA_TYPES = ("boundingbox", "depth", "rgbd", "segmentation", "thermal")


def robot(name: str, pose: str) -> str:
    """Falling and rotating robot; a link of a nested model has the same sensors as its base."""
    every = sensors(sorted(SIMULATED_CAMERAS - set(EXCLUDED)))
    shape = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
    arm = f'<model name="arm"><pose>0 1 0 0.3 0 0</pose><link name="base">{MASS}{shape}{every}</link></model>'
    weld = f"<parent>base</parent><child>arm::base</child>{sensors(['force_torque'])}"
    joint = f'<joint name="weld" type="fixed">{weld}</joint>'
    return f'<model name="{name}"><pose>{pose}</pose><link name="base">{MASS}{every}</link>{arm}{joint}</model>'


def advertised(sim: Simulation) -> tuple[FakeNode, Any, list[Any]]:
    node: Any = FakeNode()
    mounted: list[Any] = [*mount_cameras(sim, NativeRenderer), *mount_sensors(sim)]
    names = FrameNames.from_world(sim.world)
    make_camera_topics(node, node, [sensor for sensor in mounted if isinstance(sensor, CameraSensor)], names)
    make_sensor_topics(node, node, [sensor for sensor in mounted if not isinstance(sensor, CameraSensor)], names)
    return node, LinkTransforms(node, node, sim.world, sim.snapshot()), mounted


def world_pose(sensor: Any, snapshot: Snapshot) -> Pose:
    """World pose of the frame of a sensor's messages."""
    match sensor:
        case CameraSensor():
            return sensor.world_from_camera(snapshot) @ OPTICAL
        case SonarSensor():
            return sensor.world_from_link(snapshot) @ sensor.link_from_beam
        case ForceTorqueSensor():
            return sensor.world_from_link(snapshot)
        case _:
            return sensor.world_from_sensor(snapshot)


def test_the_frame_of_every_sensors_messages_is_at_the_sensor(tmp_path: Path) -> None:
    file = tmp_path / "w.sdf"
    models = robot("bot", "0 0 5 0.1 0.2 0.3") + robot("other", "4 0 5 0 0 1")
    shape = "<geometry><box><size>200 200 1</size></box></geometry>"
    for name, height in (("floor", -20), ("roof", 20)):
        link = f'<link name="l"><collision name="c">{shape}</collision></link>'
        models += f'<model name="{name}"><static>1</static><pose>0 0 {height} 0 0 0</pose>{link}</model>'
    file.write_text(f'<sdf version="1.8"><world name="w">{models}</world></sdf>')
    sim = trundle.load(str(file))
    for model in sim.models:
        model.set_twist(Twist(angular=(1.0, 2.0, 3.0)))
    sim.run(0.2)
    node, frames, mounted = advertised(sim)
    snapshot = sim.snapshot()
    frames.after_step(snapshot)
    for sensor in mounted:
        node.frame_ids.clear()
        sensor.after_step(snapshot)
        assert node.frame_ids, sensor.name
        for topic, frame in node.frame_ids.items():
            if frame == "world":  # contacts and heights are published in it
                continue
            actual, expected = node.tree.lookup_transform("world", frame).pose, world_pose(sensor, snapshot)
            assert actual.position == pytest.approx(expected.position, abs=1e-6), topic
            assert abs(
                sum(a * b for a, b in zip(actual.quaternion, expected.quaternion, strict=True))
            ) == pytest.approx(1.0, abs=1e-9), topic
