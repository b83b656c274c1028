"""The manifest of a simulated world."""

from pathlib import Path
from typing import Any

import pytest
from tests.page.simulated_world.fake_server import sent
from tests.page.simulated_world.worlds import CAMERA, lidar, loaded, model, world

import trundle
from trundle.page.simulated_world.body_numbers import BodyNumbers
from trundle.page.simulated_world.manifest import joint_rows, single_axes, world_manifest
from trundle.sim.simulation import Simulation

CART = """<model name="cart"><link name="base"><pose>0 0 1 0 0 0</pose>
<inertial><pose>0.1 0 0 0 0 0.5</pose><mass>3</mass>
<inertia><ixx>1</ixx><iyy>2</iyy><izz>2.5</izz><ixy>0.1</ixy><ixz>0.2</ixz><iyz>0.3</iyz></inertia></inertial>
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry>
<surface><friction><ode><mu>0.5</mu><mu2>0.25</mu2></ode></friction></surface></collision></link>
<link name="wheel"/><link name="arm"/><link name="foot"/>
<joint name="axle" type="revolute"><parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint>
<joint name="weld" type="fixed"><parent>base</parent><child>foot</child></joint>
<joint name="slide" type="prismatic"><parent>base</parent><child>arm</child>
<axis><xyz>0 0 1</xyz><limit><lower>-0.5</lower><upper>0.25</upper></limit></axis></joint>
<plugin name="p" filename="libnone.so"><topic>cmd</topic><noise><stddev>0.5</stddev></noise><wheel>a</wheel><wheel/>
</plugin></model>"""


def manifest(sim: Simulation, sensors=()) -> dict[str, Any]:
    bodies = BodyNumbers()
    bodies.update(sim.engine.compiled.link_names)
    return sent(world_manifest(sim, sensors, bodies))


def test_models_have_source_locations(tmp_path: Path) -> None:
    sim, _ = loaded(tmp_path, model("floor") + CART)

    floor, cart = manifest(sim)["models"]

    assert (floor["static"], cart["static"]) == (True, False)
    base = cart["links"][0]
    assert base["inertia"] == [1.0, 2.0, 2.5, 0.1, 0.2, 0.3]
    assert base["inertial_pose"] == pytest.approx([0.1, 0.0, 0.0, 0.0, 0.0, 0.5])
    assert (base["body"], base["mass"], base["friction"]) == (1, 3.0, [0.5, 0.25])
    assert cart["links"][1]["friction"] is None
    text = (tmp_path / "w.sdf").read_text().splitlines()
    for part in (cart, *cart["links"], *cart["joints"], *cart["plugins"]):
        file, _, line = part["source"].rpartition(":")
        assert Path(file).name == "w.sdf"
        assert f'name="{part["name"]}"' in text[int(line) - 1]
    (plugin,) = cart["plugins"]
    assert (plugin["name"], plugin["filename"]) == ("p", "libnone.so")
    assert plugin["parameters"] == [["topic", "cmd"], ["noise/stddev", "0.5"], ["wheel", "a"], ["wheel", ""]]


def test_plugins_of_the_same_name_are_numbered(tmp_path: Path) -> None:
    tags = "".join(f'<plugin name="drive" filename="lib{i}.so"/>' for i in range(3))
    sim, _ = loaded(tmp_path, f'<model name="cart"><link name="base"/>{tags}</model>{tags}')

    shown = manifest(sim)

    for plugins in (shown["models"][0]["plugins"], shown["plugins"]):
        assert [plugin["name"] for plugin in plugins] == ["drive", "drive (2)", "drive (3)"]
        assert [plugin["filename"] for plugin in plugins] == ["lib0.so", "lib1.so", "lib2.so"]


def test_nested_models_are_nested_in_the_manifest(tmp_path: Path) -> None:
    inner = """<model name="arm"><link name="upper"/><link name="lower"/><joint name="elbow" type="revolute">
<parent>upper</parent><child>lower</child><axis><xyz>0 1 0</xyz></axis></joint>
<model name="hand"><link name="palm"/></model></model>"""
    sim, _ = loaded(
        tmp_path,
        f"""<model name="robot"><link name="base"/>{inner}<joint name="shoulder" type="fixed">
<parent>base</parent><child>arm::upper</child></joint></model>""",
    )

    (robot,) = manifest(sim)["models"]

    (arm,) = robot["models"]
    (hand,) = arm["models"]
    assert [[(link["name"], link["body"]) for link in part["links"]] for part in (robot, arm, hand)] == [
        [("base", 0)],
        [("upper", 1), ("lower", 2)],
        [("palm", 3)],
    ]
    (shoulder,), (elbow,) = robot["joints"], arm["joints"]
    assert (shoulder["name"], shoulder["child"]) == ("shoulder", "arm::upper")
    assert (elbow["name"], elbow["parent"], elbow["child"], elbow["index"]) == ("elbow", "upper", "lower", 0)


def test_joints_with_one_axis_have_a_row(tmp_path: Path) -> None:
    sim, _ = loaded(tmp_path, CART)

    axle, weld, slide = manifest(sim)["models"][0]["joints"]

    assert (axle["type"], axle["parent"], axle["child"]) == ("revolute", "base", "wheel")
    assert (axle["lower"], axle["upper"], axle["index"]) == (None, None, 0)
    assert (weld["type"], weld["index"]) == ("fixed", None)
    assert (slide["lower"], slide["upper"], slide["index"]) == (-0.5, 0.25, 1)
    assert joint_rows(sim) == {"cart::axle": 0, "cart::slide": 1}
    assert single_axes(sim).tolist() == [0, 2]


def test_sensors_and_cameras_name_their_topics(tmp_path: Path) -> None:
    sim, sensors = loaded(tmp_path, model("eye", lidar() + CAMERA))

    shown = manifest(sim, sensors)

    (link,) = shown["models"][0]["links"]
    by_name = {sensor["name"]: sensor for sensor in link["sensors"]}
    expected = {
        "name": "cam",
        "type": "camera",
        "rate": 5.0,
        "topic": "/eye/l/cam/image_raw",
        "series": [],
        "plugins": [],
    }
    assert by_name["cam"].items() >= expected.items()
    assert by_name["scan"]["topic"] is None  # nothing publishes it without ROS
    (camera,) = shown["cameras"]
    assert (camera["name"], camera["topic"], camera["body"]) == ("cam", "/eye/l/cam/image_raw", 0)
    assert camera["pose"] == pytest.approx([0.5, 0.0, 0.0, 0.0, 0.0, 1.0])
    assert (camera["width"], camera["height"], camera["horizontal_fov"]) == (8, 6, 1.0)


def test_topics_are_those_on_the_graph(tmp_path: Path) -> None:
    plugin = """<plugin name="p" filename="libgazebo_ros_camera.so"><cameraName>front</cameraName>
<imageTopicName>picture</imageTopicName></plugin>"""
    camera = CAMERA.replace("</sensor>", plugin + "</sensor>")
    (tmp_path / "w.sdf").write_text(world(model("eye", lidar() + camera)))
    with trundle.load(str(tmp_path / "w.sdf"), ros=True) as sim:
        mounted = sim._sensors
        sensors = [*mounted.cameras, *mounted.instruments]

        shown = manifest(sim, sensors)

    topics = {sensor["name"]: sensor["topic"] for sensor in shown["models"][0]["links"][0]["sensors"]}
    assert topics["scan"] == "/eye/l/scan/scan"
    assert topics["cam"] == shown["cameras"][0]["topic"]
    assert topics["cam"].endswith("front/picture")


def test_the_manifest_has_lights_scene_and_frames(tmp_path: Path) -> None:
    lights = """<light name="sun" type="directional"/><light name="lamp" type="point"/><scene>
<ambient>0.1 0.2 0.3 1</ambient><shadows>0</shadows><grid>0</grid><sky/>
<fog><type>linear</type><color>1 0 0 1</color><start>2</start><end>9</end><density>0.5</density></fog></scene>"""
    inner = '<light name="torch" type="spot"><spot><inner_angle>0.1</inner_angle></spot></light>'
    sim, _ = loaded(tmp_path, lights + model("m", inner))

    shown = manifest(sim)

    assert [(light["name"], light["type"]) for light in shown["lights"]] == [
        ("sun", "directional"),
        ("lamp", "point"),
        ("m::l::torch", "spot"),
    ]
    assert shown["scene"]["ambient"] == pytest.approx((0.1, 0.2, 0.3))
    assert (shown["scene"]["sky"], shown["scene"]["shadows"], shown["scene"]["grid"]) == (True, False, False)
    fog = shown["scene"]["fog"]
    assert fog == {"type": "linear", "color": [1.0, 0.0, 0.0], "start": 2.0, "end": 9.0, "density": 0.5}
    assert shown["frames"] == [{"frame": "m/l", "parent": "world", "body": 0}]


def test_the_robot_is_the_model_with_the_most_joints() -> None:
    sim = trundle.load("rp2w_at_home.world")

    shown = manifest(sim)

    assert shown["robot"] is not None
    assert sim.engine.compiled.link_names[shown["robot"]] == "rp2w::chassis"


def test_a_world_of_static_models_has_no_robot(tmp_path: Path) -> None:
    sim, _ = loaded(tmp_path, model("floor"))

    assert manifest(sim)["robot"] is None
