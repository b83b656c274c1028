"""Behavior of ROS' Python libraries beyond the originals', or without their dependencies."""

import subprocess
import sys
from pathlib import Path

import pytest
from tests.ros.rospy.programs import environment

TIMEOUT_S = 120.0


def _run(code: str, folder: Path) -> str:
    """Output of code in a Python of its own, where importing OpenCV fails."""
    prologue = "import sys\nsys.modules['cv2'] = None\n"
    env = environment(sys.executable, "http://localhost:1", folder) | {"ROS_PACKAGE_PATH": str(folder)}
    done = subprocess.run(
        [sys.executable, "-c", prologue + code],
        env=env,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )
    return done.stdout + done.stderr


def test_images_convert_without_opencv(tmp_path: Path) -> None:
    code = """
import numpy as np
from cv_bridge import CvBridge, CvBridgeError
from sensor_msgs.msg import Image
bridge = CvBridge()
red = np.zeros((2, 3, 3), np.uint8)
red[..., 2] = 200
message = bridge.cv2_to_imgmsg(red, "bgr8")
print(message.encoding, message.width, message.height, message.step)
print(bridge.imgmsg_to_cv2(message, "rgb8")[0, 0].tolist(), bridge.imgmsg_to_cv2(message, "mono8")[0, 0])
print(bridge.imgmsg_to_cv2(message, "rgba8").shape, bridge.imgmsg_to_cv2(message, "bgr16")[0, 0].tolist())
depth = bridge.cv2_to_imgmsg(np.full((2, 2), 1.5, np.float32), "32FC1")
print(bridge.imgmsg_to_cv2(depth).tolist(), bridge.cv2_to_imgmsg(red).encoding)
padded = Image(height=2, width=2, encoding="mono8", step=4, data=bytes([1, 2, 0, 0, 3, 4, 0, 0]))
print(bridge.imgmsg_to_cv2(padded).tolist())
big = Image(height=1, width=2, encoding="16UC1", step=4, is_bigendian=1, data=bytes([1, 0, 0, 2]))
print(bridge.imgmsg_to_cv2(big).tolist())
picture = bridge.cv2_to_compressed_imgmsg(red, "png")
print(picture.format, bridge.compressed_imgmsg_to_cv2(picture)[0, 0].tolist())
print(bridge.compressed_imgmsg_to_cv2(picture, "rgb8")[0, 0].tolist(), bridge.encoding_to_cvtype2("bgr8"))
for bad in (
    lambda: bridge.imgmsg_to_cv2(Image(encoding="nope")),
    lambda: bridge.imgmsg_to_cv2(Image(height=9, width=9, encoding="mono8", step=9, data=b"short")),
    lambda: bridge.imgmsg_to_cv2(depth, "bgr8"),
    lambda: bridge.cv2_to_imgmsg(red, "mono8"),
    lambda: bridge.compressed_imgmsg_to_cv2(type(picture)(data=b"no image")),
    lambda: bridge.imgmsg_to_cv2(Image(height=2, width=2, encoding="bayer_rggb8", step=2, data=bytes(4)), "bgr8"),
):
    try:
        print("no error", bad())
    except CvBridgeError as error:
        print("error:", error)
"""
    lines = _run(code, tmp_path).splitlines()
    assert lines[:10] == [
        "bgr8 3 2 9",
        "[200, 0, 0] 60",
        "(2, 3, 4) [0, 0, 51400]",
        "[[1.5, 1.5], [1.5, 1.5]] 8UC3",
        "[[1, 2], [3, 4]]",
        "[[256, 2]]",
        "png [0, 0, 200]",
        "[200, 0, 0] 16",
        "error: Unrecognized image encoding [nope]",
        lines[9],
    ]
    assert all(line.startswith("error:") for line in lines[8:])
    assert len(lines) == 14
    assert "pip install opencv-python-headless" in lines[-1]


def test_images_in_a_named_encoding_can_be_drawn_on(tmp_path: Path) -> None:
    code = """
from io import BytesIO
from cv_bridge import CvBridge
from sensor_msgs.msg import Image
def received(encoding, pixel):
    buffer = BytesIO()
    Image(height=1, width=2, encoding=encoding, step=2 * pixel, data=bytes(2 * pixel)).serialize(buffer)
    return Image().deserialize(buffer.getvalue())
for source, pixel, target in (("bgr8", 3, "bgr8"), ("rgb8", 3, "bgr8"), ("mono8", 1, "mono8"), ("16UC1", 2, "mono16"),
                              ("32FC1", 4, "32FC1"), ("8UC3", 3, "bgr8"), ("mono8", 1, "mono16")):
    message = received(source, pixel)
    image = CvBridge().imgmsg_to_cv2(message, target)
    image[0, 0] = 7
    print(source, image.dtype, image.max(), sum(message.data))
"""
    assert _run(code, tmp_path).splitlines() == [
        "bgr8 uint8 7 0", "rgb8 uint8 7 0", "mono8 uint8 7 0", "16UC1 uint16 7 0", "32FC1 float32 7.0 0",
        "8UC3 uint8 7 0", "mono8 uint16 7 0",
    ]  # fmt: skip


def test_depth_is_displayed_as_gray_levels(tmp_path: Path) -> None:
    code = """
import numpy as np
from cv_bridge import cvtColorForDisplay
depth = np.array([[0.5, 1.0], [2.5, np.nan]], np.float32)
print(cvtColorForDisplay(depth, "32FC1", "mono8", min_image_value=0.5, max_image_value=2.5).tolist())
print(cvtColorForDisplay(depth, "32FC1", "", do_dynamic_scaling=True)[..., 0].tolist())
print(cvtColorForDisplay(np.array([[100, 1500]], np.uint16), "16UC1", "mono8", False, 500, 1500).tolist())
print(cvtColorForDisplay(np.array([[257, 65535]], np.uint16), "16UC1", "mono8").tolist())
print(cvtColorForDisplay(np.full((1, 1), 7.0), "64FC1", "bgr8", True).tolist())
print(cvtColorForDisplay(np.array([[[1, 2, 3]]], np.uint8), "rgb8", "bgr8").tolist())
for encodings in (("8UC1", "bgr8"), ("rgb8", "32FC1"), ("32SC1", "bgr8")):
    try:
        cvtColorForDisplay(np.zeros((1, 1), np.uint8), *encodings)
    except RuntimeError as error:
        print(error)
"""
    lines = _run(code, tmp_path).splitlines()
    assert lines[:6] == [
        "[[0, 64], [255, 0]]", "[[0, 64], [255, 0]]", "[[0, 255]]", "[[1, 255]]", "[[[128, 128, 128]]]",
        "[[[3, 2, 1]]]",
    ]  # fmt: skip
    assert [line.partition("isplay")[0] for line in lines[6:]] == ["cv_bridge.cvtColorForD"] * 3
    assert "[8UC1] is not a color format" in lines[6]


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """Package with a .cfg file."""
    folder = tmp_path / "pumps"
    (folder / "cfg").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>pumps</name><version>1.0.0</version></package>")
    (folder / "cfg/Pump.cfg").write_text(
        "#!/usr/bin/env python\n"
        'PACKAGE = "pumps"\n'
        "from dynamic_reconfigure.parameter_generator_catkin import *\n"
        "gen = ParameterGenerator()\n"
        'modes = gen.enum([gen.const("Slow", int_t, 0, "little"), gen.const("Fast", int_t, 1, "much")], "speeds")\n'
        'gen.add("flow", double_t, 1, "the pump\'s litres per second", 0.5, 0, 2)\n'
        'gen.add("mode", int_t, 2, "speed", 0, 0, 1, edit_method=modes)\n'
        'gen.add_group("limits", state=False).add("name", str_t, 4, "of the pump")\n'
        'exit(gen.generate(PACKAGE, "pumps", "Pump"))\n'
    )
    return folder


def test_a_cfg_file_is_a_module_without_a_build(package: Path) -> None:
    code = """
from pumps.cfg import PumpConfig as c
print(c.defaults, c.min["flow"], c.max["flow"], c.level, c.all_level, c.type, c.Pump_Fast)
print(c.config_description["groups"][0]["name"], [p["name"] for p in c.extract_params(c.config_description)])
from dynamic_reconfigure.encoding import decode_description, encode_description
print(decode_description(encode_description(c))["groups"]["limits"]["parameters"][0]["name"])
"""
    assert _run(code, package.parent).splitlines() == [
        "{'flow': 0.5, 'mode': 0, 'name': ''} 0.0 2.0 {'flow': 1, 'mode': 2, 'name': 4} 7 "
        "{'flow': 'double', 'mode': 'int', 'name': 'str'} 1",
        "limits ['flow', 'mode', 'name']",
        "name",
    ]


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ('gen.add("flow", double_t, 1, "twice", "much")', "cfg/Pump.cfg:10: error: TypeError: 'flow' has type double"),
        ("gen.add(", "cfg/Pump.cfg:10: error: SyntaxError"),
        ('gen.add("1st", int_t, 1, "bad")', "'1st' is not a parameter's name"),
    ],
)
def test_the_error_of_a_faulty_cfg_file_names_file_and_line(package: Path, line: str, error: str) -> None:
    file = package / "cfg/Pump.cfg"
    file.write_text(file.read_text().replace("exit(", "exit_code = (") + line + "\n")
    assert error in _run("import pumps.cfg.PumpConfig", package.parent)


def test_results_files_of_tests_are_valid_xml_whatever_the_tests_print(tmp_path: Path) -> None:
    """Such as invalid UTF-8, and characters that XML does not allow."""
    code = """
import rosunit, unittest, xml.etree.ElementTree

class Printing(unittest.TestCase):
    def test_it(self):
        print("a\\udcff b\\0 c\\U0001f916")

rosunit.unitrun("package", "name", Printing, ["program", "--gtest_output=xml:FOLDER/out.xml"])
print(ascii(xml.etree.ElementTree.parse("FOLDER/out.xml").getroot().find("system-out").text))
"""
    printed = _run(code.replace("FOLDER", str(tmp_path)), tmp_path)
    assert printed.splitlines()[-1] == r"'a? b? c\U0001f916\n'"


def test_smach_accepts_only_plain_userdata_from_the_network(tmp_path: Path) -> None:
    code = """
import base64, os, pickle
from smach_ros import local_data
print(local_data.decode(local_data.encode({"a": [1, "b", None], "f": lambda: 1})))
class Evil:
    def __reduce__(self):
        return os.system, ("echo run",)
for data in (base64.b64encode(pickle.dumps({"x": Evil()})).decode(), "!!", base64.b64encode(b"\\x80").decode()):
    try:
        print(local_data.decode(data))
    except ValueError as error:
        print("refused")
"""
    assert _run(code, tmp_path).splitlines() == ["{'a': [1, 'b', None]}", "refused", "refused", "refused"]


@pytest.mark.parametrize(
    ("statement", "advice"),
    [
        ("from PyKDL import ChainIdSolver_RNE", "cannot import name 'ChainIdSolver_RNE'"),
        ("import PyKDL; PyKDL.ChainIdSolver_RNE", "python3-pykdl"),
        ("import genpy.generator", "genpy.dynamic.generate_dynamic"),
        ("from genmsg.template_tools import generate_from_command_line_options", "python3-genpy"),
        ("import roslib.gentools", "genmsg.gentools"),
        ("from rosunit import pmon", "trundle test"),
    ],
)
def test_errors_of_missing_modules_name_a_way_out(statement: str, advice: str, tmp_path: Path) -> None:
    assert advice in _run(statement, tmp_path)


def test_a_bag_that_is_appended_to_stays_unchanged_until_it_is_closed(tmp_path: Path) -> None:
    code = f"""
import genpy, rosbag
from std_msgs.msg import String
path = {str(tmp_path / "a.bag")!r}
with rosbag.Bag(path, "w") as bag:
    bag.write("/a", String("one"), genpy.Time(1))
appending = rosbag.Bag(path, "a")
appending.write("/a", String("two"), genpy.Time(2))
print([m.message.data for m in rosbag.Bag(path)])
appending.close()
print([m.message.data for m in rosbag.Bag(path)])
"""
    assert _run(code, tmp_path).splitlines() == ["['one']", "['one', 'two']"]
    assert [path.name for path in tmp_path.iterdir() if path.suffix == ".bag"] == ["a.bag"]


def test_a_bag_that_is_written_is_not_overwritten(tmp_path: Path) -> None:
    """With the original, two writers produce one unreadable file."""
    code = f"""
import genpy, rosbag
from std_msgs.msg import String
path = {str(tmp_path / "a.bag")!r}
first = rosbag.Bag(path, "w")
first.write("/a", String("one"), genpy.Time(1))
for mode in "wa":
    try:
        rosbag.Bag(path, mode)
    except OSError as error:
        print("writes it: end that, or choose another name" in str(error))
first.close()
print([m.message.data for m in rosbag.Bag(path)])
left = rosbag.Bag(path, "w")
left = None
rosbag.Bag(path, "w").close()
"""
    assert _run(code, tmp_path).splitlines() == ["True", "True", "['one']"]
    assert [path.name for path in tmp_path.iterdir() if "a.bag" in path.name] == ["a.bag"]


def test_an_encrypted_bag_is_refused_with_the_way_out(tmp_path: Path) -> None:
    code = f"""
import struct, genpy, rosbag
from std_msgs.msg import String
path = {str(tmp_path / "a.bag")!r}
with rosbag.Bag(path, "w") as bag:
    bag.set_encryptor("rosbag/NoEncryptor")
    bag.write("/a", String("one"), genpy.Time(1))
    try:
        bag.set_encryptor("rosbag/AesCbcEncryptor", "*")
    except rosbag.ROSBagEncryptNotSupportedException as error:
        print(error)
data = open(path, "rb").read()
length = struct.unpack_from("<I", data, 13)[0]  # of the first record's header, whose data are blanks
header, blanks = data[17 : 17 + length], struct.unpack_from("<I", data, 17 + length)[0]
field = b"encryptor=rosbag/AesCbcEncryptor"
header += struct.pack("<I", len(field)) + field
rest = blanks - len(field) - 4
record = struct.pack("<I", len(header)) + header + struct.pack("<I", rest) + b" " * rest
open(path, "wb").write(data[:13] + record + data[21 + length + blanks :])
try:
    rosbag.Bag(path)
except rosbag.ROSBagEncryptNotSupportedException as error:
    print(error)
"""
    written, read = _run(code, tmp_path).splitlines()
    assert written == "encryption (rosbag/AesCbcEncryptor) is not supported; write the bag without it"
    assert "'rosbag/AesCbcEncryptor' is not supported" in read
    assert read.endswith("rosbag decrypt a.bag")


def test_every_library_is_importable(tmp_path: Path) -> None:
    names = (
        "PyKDL actionlib angles cv_bridge diagnostic_updater dynamic_reconfigure.server dynamic_reconfigure.client "
        "image_geometry interactive_markers.interactive_marker_server interactive_markers.menu_handler laser_geometry "
        "message_filters ros_numpy rosbag sensor_msgs.point_cloud2 six.moves smach smach_ros tf tf.transformations "
        "tf2_geometry_msgs tf2_py tf2_ros tf2_sensor_msgs tf_conversions.posemath urdf_parser_py.urdf xacro"
    )
    code = f"import importlib\nfor name in {names.split()!r}: importlib.import_module(name)\nprint('all')"
    assert _run(code, tmp_path) == "all\n"


def test_submodules_of_roslib_need_no_separate_import(tmp_path: Path) -> None:
    code = "import roslib\nprint(roslib.message.get_message_class('std_msgs/String').__name__, hasattr(roslib, 'no'))"
    assert _run(code, tmp_path) == "String False\n"


def test_rates_and_bandwidths_of_topics_are_measured(tmp_path: Path) -> None:
    """Programs pass rostopic's meters to subscribers; a reset of time resets the meter."""
    code = """
import rospy
from rostopic import ROSTopicBandwidth, ROSTopicHz
hz, now = ROSTopicHz(10, filter_expr=lambda m: m != "other"), [0.0]
rospy.get_rostime = lambda: rospy.Time.from_sec(now[0])
for now[0], message in ((1.0, "a"), (1.5, "b"), (1.7, "other"), (2.5, "c")):
    hz.callback_hz(message)
print(hz.get_hz(), hz.get_hz())
hz.print_hz()
for now[0] in (0.0, 5.0, 5.25):
    hz.callback_hz("a")
hz.print_hz()
bw = ROSTopicBandwidth()
for size in (10, 30):
    bw.callback(rospy.AnyMsg().deserialize(bytes(size)))
print(bw.get_bw()[1:])
"""
    assert _run(code, tmp_path).splitlines() == [
        f"({1 / 0.75}, 0.5, 1.0, 0.25, 3) None",
        "no new messages",
        "time has reset, resetting counters",
        "average rate: 4.000",
        "\tmin: 0.250s max: 0.250s std dev: 0.00000s window: 2",
        "(20.0, 10, 30, 2)",
    ]
