"""For every sensor type and mount: the messages' frame is in tf, at the sensor's pose."""

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
SILENT = ("force_torque", "rfidtag", "wireless_transmitter")
"""Sensors without a link frame or without messages."""
OPTICAL = Pose(quaternion=quaternion_from_rpy(-1.5707963267948966, 0.0, -1.5707963267948966))


class Ear:
    """Stand-in for a node: keeps the frames that messages name, and all of tf."""

    def __init__(self) -> None:
        self.tree = TransformBuffer()
        self.named: dict[str, str] = {}
        """Topic → frame_id of its messages."""

    def advertise(self, topic: str, type_: str, **_: Any) -> Any:
        is_tree = topic.startswith("/tf")

        def publish(message: Any) -> None:
            for item in message.get("transforms", [message]):
                if is_tree:
                    t, q = item["transform"]["translation"], item["transform"]["rotation"]
                    placed = (t["x"], t["y"], t["z"]), (q["w"], q["x"], q["y"], q["z"])
                    self.take(item["header"]["frame_id"], item["child_frame_id"], item["header"]["stamp"], *placed)
                else:
                    self.named[topic] = item["header"]["frame_id"]

        return SimpleNamespace(topic=topic, type=type_, publish=publish, has_subscribers=True)

    def take(self, parent: str, child: str, stamp: int, place: Any, turn: Any) -> None:
        assert self.tree.frames().get(child) in (None, parent), f"{child} has two parents"
        made = Transform(parent=parent, child=child, stamp_ns=stamp, translation=place, rotation=turn)
        self.tree.set_transform(made, static=stamp == 0)

    def send_transform(self, *transforms: Transform) -> None:
        """Take the place of the static broadcaster."""
        for each in transforms:
            self.take(each.parent, each.child, 0, each.translation, each.rotation)

    def new(self, type_: str, message: Any) -> Any:
        del type_
        return message


def sensors(types: list[str]) -> str:
    def one(type_: str) -> str:
        inside = SETTINGS.get(type_, SMALL if "cam" in type_ or type_ in SEEING else "")
        rate = "<pose>0.3 0.2 0.1 0.4 0.5 0.6</pose><always_on>1</always_on><update_rate>100</update_rate>"
        return f'<sensor name="{type_}" type="{type_}">{rate}{inside}</sensor>'

    return "".join(one(type_) for type_ in types)


SEEING = ("boundingbox", "depth", "rgbd", "segmentation", "thermal")


def robot(name: str, place: str) -> str:
    """Robot that falls and turns; a nested model's link has the same sensors as its own."""
    every = sensors(sorted(SIMULATED_CAMERAS - set(SILENT)))
    shape = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
    arm = f'<model name="arm"><pose>0 1 0 0.3 0 0</pose><link name="base">{MASS}{shape}{every}</link></model>'
    weld = f"<parent>base</parent><child>arm::base</child>{sensors(['force_torque'])}"
    joint = f'<joint name="weld" type="fixed">{weld}</joint>'
    return f'<model name="{name}"><pose>{place}</pose><link name="base">{MASS}{every}</link>{arm}{joint}</model>'


def spoken(sim: Simulation) -> tuple[Ear, Any, list[Any]]:
    ear: Any = Ear()
    mounted: list[Any] = [*mount_cameras(sim, NativeRenderer), *mount_sensors(sim)]
    names = FrameNames.from_world(sim.world)
    make_camera_topics(ear, ear, [each for each in mounted if isinstance(each, CameraSensor)], names)
    make_sensor_topics(ear, ear, [each for each in mounted if not isinstance(each, CameraSensor)], names)
    return ear, LinkTransforms(ear, ear, sim.world, sim.snapshot()), mounted


def placed(sensor: Any, snapshot: Snapshot) -> Pose:
    """Pose in the world of the axes of its messages."""
    match sensor:
        case CameraSensor():
            return sensor.world_from_camera(snapshot) @ OPTICAL
        case SonarSensor():
            return sensor.world_from_link(snapshot) @ sensor.link_from_beam
        case ForceTorqueSensor():
            return sensor.world_from_link(snapshot)
        case _:
            return sensor.world_from_sensor(snapshot)


def test_every_sensor_speaks_in_a_frame_that_is_where_the_sensor_is(tmp_path: Path) -> None:
    file = tmp_path / "w.sdf"
    both = robot("bot", "0 0 5 0.1 0.2 0.3") + robot("other", "4 0 5 0 0 1")
    shape = "<geometry><box><size>200 200 1</size></box></geometry>"
    for name, height in (("floor", -20), ("roof", 20)):
        link = f'<link name="l"><collision name="c">{shape}</collision></link>'
        both += f'<model name="{name}"><static>1</static><pose>0 0 {height} 0 0 0</pose>{link}</model>'
    file.write_text(f'<sdf version="1.8"><world name="w">{both}</world></sdf>')
    sim = trundle.load(str(file))
    for model in sim.models:
        model.set_twist(Twist(angular=(1.0, 2.0, 3.0)))
    sim.run(0.2)
    ear, frames, mounted = spoken(sim)
    now = sim.snapshot()
    frames.after_step(now)
    for sensor in mounted:
        ear.named.clear()
        sensor.after_step(now)
        assert ear.named, sensor.name
        for topic, frame in ear.named.items():
            if frame == "world":  # contacts and heights are published in it
                continue
            found, expected = ear.tree.lookup_transform("world", frame).pose, placed(sensor, now)
            assert found.position == pytest.approx(expected.position, abs=1e-6), topic
            assert abs(sum(a * b for a, b in zip(found.quaternion, expected.quaternion, strict=True))) == pytest.approx(
                1.0, abs=1e-9
            ), topic
