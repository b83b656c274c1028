"""Messages: md5 sums, definitions, bytes and values; compared with genpy where Debian's ROS is installed."""

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trundle.ros import MessageError, Messages

REAL = Path("/usr/lib/python3/dist-packages/genpy")
TYPES = [
    "sensor_msgs/Image",
    "tf2_msgs/TFMessage",
    "sensor_msgs/JointState",
    "nav_msgs/Odometry",
    "rosgraph_msgs/Log",
    "sensor_msgs/CameraInfo",
    "rosgraph_msgs/Clock",
    "diagnostic_msgs/DiagnosticArray",
    "sensor_msgs/LaserScan",
    "sensor_msgs/PointCloud2",
    "std_msgs/Empty",
    "std_msgs/Byte",
    "std_msgs/Char",
    "std_msgs/UInt8MultiArray",
    "std_msgs/Duration",
    "nav_msgs/OccupancyGrid",
]

SUMS = """
import importlib, json, pkgutil, sys
out = {}
for package in ("actionlib_msgs", "diagnostic_msgs", "geometry_msgs", "nav_msgs", "rosgraph_msgs", "sensor_msgs",
                "std_msgs", "std_srvs", "tf2_msgs", "roscpp"):
    for kind in ("msg", "srv"):
        try:
            module = importlib.import_module(f"{package}.{kind}")
        except ImportError:
            continue
        for name in dir(module):
            cls = getattr(module, name)
            if hasattr(cls, "_md5sum") and (kind == "msg" or hasattr(cls, "_request_class")):
                out[f"{kind} {cls._type}"] = cls._md5sum
print(json.dumps(out))
"""

FILLED = """
import importlib, json, sys, genpy, io
def fill(kind, depth=1):
    base, bracket, size = kind.partition("[")
    if bracket:
        count = int(size[:-1]) if size[:-1] else 3
        values = [fill(base, depth + i) for i in range(count)]
        return bytes(values) if base in ("uint8", "char") else values
    if base == "bool": return depth % 2 == 1
    if base == "string": return f"text {depth}"
    if base.startswith("float"): return depth + 0.5
    if base == "time": return genpy.Time(depth, 5)
    if base == "duration": return genpy.Duration(depth, 5)
    if "/" not in base and base != "Header": return depth
    package, name = base.split("/") if "/" in base else ("std_msgs", base)
    cls = getattr(importlib.import_module(package + ".msg"), name)
    return cls(*[fill(t, depth + i) for i, t in enumerate(cls._slot_types)])
out = {}
for kind in sys.argv[1:]:
    buffer = io.BytesIO()
    try:
        fill(kind).serialize(buffer)
    except ImportError:  # its package, or one of a field, is not installed
        continue
    out[kind] = buffer.getvalue().hex()
print(json.dumps(out))
"""


def _real_python(tmp_path: Path, code: str, *arguments: str) -> Any:
    if not REAL.is_dir():
        pytest.skip("Debian's python3-genpy is not installed")
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path)}
    command = ["/usr/bin/python3", "-W", "ignore", "-c", code, *arguments]
    return json.loads(subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout)


@pytest.mark.real_ros
def test_every_md5_sum_matches_genpy(messages: Messages, tmp_path: Path) -> None:
    wrong: list[str] = []
    missing: list[str] = []
    for key, md5sum in _real_python(tmp_path, SUMS).items():
        kind, _, name = key.partition(" ")
        try:
            md5 = messages.md5(name) if kind == "msg" else messages.service(name).md5sum
        except MessageError:
            missing.append(name)
            continue
        if md5 != md5sum:
            wrong.append(name)
    assert wrong == []
    assert [name for name in missing if "LookupTransform" not in name] == []


def test_threads_may_compute_the_same_md5_sum_at_once() -> None:
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as pool:
            for _ in range(20):
                fresh = Messages()
                sums = set(pool.map(fresh.md5, ["nav_msgs/Odometry"] * 8))
                assert sums == {"cd5e73d190d741a2f92e81eda573aca7"}
    finally:
        sys.setswitchinterval(interval)


def _filled(messages: Messages, kind: str, depth: int = 1) -> Any:
    base, bracket, size = kind.partition("[")
    if bracket:
        return [_filled(messages, base, depth + i) for i in range(int(size[:-1]) if size[:-1] else 3)]
    if base == "bool":
        return depth % 2 == 1
    if base == "string":
        return f"text {depth}"
    if base.startswith("float"):
        return depth + 0.5
    if base in ("time", "duration"):
        return {"secs": depth, "nsecs": 5}
    if "/" not in base:
        return depth
    return {f: _filled(messages, t, depth + i) for i, (f, t) in enumerate(messages.fields(base).items())}


@pytest.mark.real_ros
def test_serialized_bytes_match_genpy(messages: Messages, tmp_path: Path) -> None:
    real = _real_python(tmp_path, FILLED, *TYPES)
    assert "std_msgs/Duration" in real
    for kind, data in real.items():
        assert bytes(messages.serialize(messages.new(kind, _filled(messages, kind)))).hex() == data, kind


@pytest.mark.parametrize("kind", TYPES)
def test_a_message_survives_serialization(messages: Messages, kind: str) -> None:
    message = messages.new(kind, _filled(messages, kind))
    data = bytes(messages.serialize(message))
    assert bytes(messages.serialize(messages.deserialize(data, kind))) == data


@pytest.mark.parametrize("kind", ["sensor_msgs/Image", "tf2_msgs/TFMessage", "rosgraph_msgs/Log"])
def test_truncated_bytes_of_any_length_are_refused(messages: Messages, kind: str) -> None:
    data = bytes(messages.serialize(messages.new(kind, _filled(messages, kind))))
    for size in range(len(data)):
        with pytest.raises(MessageError, match=kind):
            messages.deserialize(data[:size], kind)


def test_a_full_definition_lists_its_dependencies_like_genmsg(messages: Messages) -> None:
    line = "=" * 80
    assert messages.definition("tf2_msgs/TFMessage").startswith(
        f"geometry_msgs/TransformStamped[] transforms\n\n{line}\nMSG: geometry_msgs/TransformStamped\n"
    )
    names = [part for part in messages.definition("nav_msgs/Odometry").split("\n") if part.startswith("MSG: ")]
    assert names == [
        "MSG: std_msgs/Header",
        "MSG: geometry_msgs/PoseWithCovariance",
        "MSG: geometry_msgs/Pose",
        "MSG: geometry_msgs/Point",
        "MSG: geometry_msgs/Quaternion",
        "MSG: geometry_msgs/TwistWithCovariance",
        "MSG: geometry_msgs/Twist",
        "MSG: geometry_msgs/Vector3",
    ]


def test_omitted_fields_are_zero_and_now_and_auto_are_stamped(messages: Messages) -> None:
    message = messages.new("nav_msgs/Odometry", {"header": "auto", "pose": {"pose": {"position": [1, 2, 3]}}}, now_ns=5)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (0, 5)
    assert message.pose.pose.position.z == 3.0
    assert message.pose.covariance.tolist() == [0.0] * 36
    assert messages.new("std_msgs/Header", {"stamp": "now"}, now_ns=2_000_000_001).stamp.sec == 2


@pytest.mark.parametrize(
    ("kind", "fields", "reason"),
    [
        ("geometry_msgs/Twist", {"lineer": {}}, "no field 'lineer'; fields here: 'linear', 'angular'"),
        ("geometry_msgs/Twist", {"linear": {"q": 1}}, "field 'linear': geometry_msgs/Vector3 has no field 'q'"),
        ("geometry_msgs/Twist", {"linear": {"x": "a"}}, "field 'linear.x' is a float64, got 'a'"),
        ("geometry_msgs/Twist", [[1, 2], [0, 0, 0]], r"3 fields \(x, y, z\), got 2 values"),
        ("std_msgs/String", {"data": 5}, "field 'data' is a string, got 5; quote it"),
        ("std_msgs/UInt8", {"data": 256}, r"field 'data' is a uint8 \(0 to 255\), got 256"),
        ("std_msgs/Bool", {"data": "yes"}, "field 'data' is a bool"),
        ("sensor_msgs/JointState", {"position": [1, "b"]}, r"field 'position\[1\]' is a float64"),
        ("sensor_msgs/JointState", {"name": "a"}, "field 'name' is a list"),
        ("sensor_msgs/Imu", {"orientation_covariance": [1.0]}, "exactly 9 elements, got 1"),
        ("std_msgs/Header", {"stamp": "soon"}, "field 'stamp': a time is"),
        (
            "std_msgs/Sting",
            {},
            r"no message type 'std_msgs/Sting' \(did you mean 'std_msgs/String'\?\); messages of std_msgs: ",
        ),
        ("Twist", {}, "package/Name"),
        ("nope_msgs/X", {}, "no messages of a package 'nope_msgs' are known"),
    ],
)
def test_an_invalid_field_is_reported_with_the_valid_ones(
    messages: Messages, kind: str, fields: object, reason: str
) -> None:
    with pytest.raises(MessageError, match=reason):
        messages.new(kind, fields)


def test_lists_in_array_fields_are_serialized(messages: Messages) -> None:
    message = messages.new("sensor_msgs/JointState")
    message.position = [1, 2.5]
    assert messages.deserialize(messages.serialize(message), "sensor_msgs/JointState").position.tolist() == [1.0, 2.5]
    message.position = ["a"]
    with pytest.raises(MessageError, match=r"position\[0\]"):
        messages.serialize(message)


def test_image_data_may_be_a_numpy_array_or_bytes(messages: Messages) -> None:
    image = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
    for data in (image, image.tobytes()):
        assert messages.new("sensor_msgs/Image", {"data": data}).data.tolist() == list(range(12))


def test_types_are_read_from_a_package_folder(tmp_path: Path) -> None:
    for name, text in {
        "msg/Part.msg": "float32 SIZE=1.50  # a comment\nstring NAME=a # b \nHeader header\nOther[2] others\n",
        "msg/Other.msg": "uint8 value\n",
        "srv/Ask.srv": "Part part\n---\nbool ok\n",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    messages = Messages()
    messages.add_package("my_msgs", tmp_path)

    assert messages.fields("my_msgs/Part") == {"header": "std_msgs/Header", "others": "my_msgs/Other[2]"}
    service = messages.service("my_msgs/Ask")
    assert messages.new(service.request).part.others[1].value == 0
    assert messages.definition("my_msgs/Part").startswith("float32 SIZE=1.50  # a comment\n")


def test_a_folder_adds_types_to_a_shipped_package(tmp_path: Path) -> None:
    """Trundle has one message of hector_uav_msgs; a workspace with the package has them all."""
    (tmp_path / "msg").mkdir()
    (tmp_path / "msg/Fuel.msg").write_text("float32 level\n", encoding="utf-8")
    (tmp_path / "msg/Altimeter.msg").write_text("string other\n", encoding="utf-8")
    messages = Messages()
    messages.add_package("hector_uav_msgs", tmp_path)

    assert messages.fields("hector_uav_msgs/Fuel") == {"level": "float32"}
    assert "qnh" in messages.fields("hector_uav_msgs/Altimeter")


def test_a_type_is_added_from_the_definition_a_publisher_sends(messages: Messages) -> None:
    line = "=" * 80
    fresh = Messages()
    fresh.add_definition("new_msgs/A", f"B b\n\n{line}\nMSG: new_msgs/B\nint32 x\n")
    assert fresh.fields("new_msgs/A") == {"b": "new_msgs/B"}
    assert not messages.has("new_msgs/A")


def test_importing_trundle_ros_loads_no_heavy_module() -> None:
    heavy = "{'asyncio', 'numpy', 'yaml'}"
    code = f"import sys, trundle.ros, trundle.ros.xmlrpc.proxy; print(sorted({heavy} & set(sys.modules)))"
    environment = {**os.environ, "PYTHONWARNINGS": "error"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    assert done.stdout.strip() == "[]"


def test_default_messages_share_no_values() -> None:
    messages = Messages()
    for kind in ("sensor_msgs/CameraInfo", "std_msgs/Empty", "tf2_msgs/TFMessage", "nav_msgs/Odometry"):
        assert bytes(messages.serialize(messages.new(kind))) == bytes(messages.serialize(messages.new(kind, {})))
    first, second = messages.new("sensor_msgs/CameraInfo"), messages.new("sensor_msgs/CameraInfo")
    first.K[0], first.header.stamp.sec, first.header.frame_id = 1.0, 2, "a"
    assert (second.K[0], second.header.stamp.sec, second.header.frame_id) == (0.0, 0, "")
    lists = messages.new("tf2_msgs/TFMessage"), messages.new("tf2_msgs/TFMessage")
    assert lists[0].transforms == []
    assert lists[0].transforms is not lists[1].transforms


def test_a_recursive_definition_is_refused() -> None:
    messages = Messages(bare=True)
    with pytest.raises(MessageError, match="Knot cannot be read: line 1: geometry_msgs/Knot contains itself"):
        messages.add_definition("geometry_msgs/Knot", "geometry_msgs/Knot inside\n")


def test_a_full_definition_holds_each_type_once() -> None:
    between = "=" * 80 + "\nMSG: a/"
    deep = "".join(f"{between}T{i}\nT{i + 1}[] x\nT{i + 1}[] y\n\n" for i in range(90))
    messages = Messages(bare=True)
    messages.add_definition("a/T", f"T0 x\n\n{deep}{between}T90\nint8 x\n")
    assert messages.definition("a/T").count("MSG:") == 91
