"""`trundle plot`: numbers of messages over time."""

import math
import re
import sys
from pathlib import Path
from typing import Any

import pytest

from trundle.base.drawing import Curve, curves_svg, curves_text
from trundle.base.xmlnode import parse_xml
from trundle.ros import WallClock


@pytest.fixture
def bag(graph: Any, tmp_path: Path) -> Path:
    """Fifty points on a line, stamped by the publisher's clock."""
    node = graph.node("talker")
    publisher = node.advertise("/points", "geometry_msgs/PointStamped", queue_size=None)
    joints = node.advertise("/joints", "sensor_msgs/JointState", queue_size=None)
    graph.ready(node)
    path = tmp_path / "run.bag"

    async def talk() -> None:
        i = 0
        while True:
            publisher.publish({"header": "auto", "point": {"x": float(i), "y": -1.0}})
            joints.publish({"name": ["a", "b"], "position": [1.0, i * 2.0]})
            i += 1
            await WallClock().sleep(0.005)

    talking = graph.loop.spawn(talk())
    assert graph.trundle("bag", "record", "-O", str(path), "-l", "50", "/points", "/joints")[0] == 0
    talking.cancel()
    return path


def _lines(svg: str) -> list[list[tuple[float, float]]]:
    lines = re.findall(r'<polyline [^>]*points="([^"]*)"', svg)
    return [[(float(x), float(y)) for x, y in (pair.split(",") for pair in line.split())] for line in lines]


def test_a_bag_is_drawn_as_a_picture(graph: Any, bag: Path, tmp_path: Path) -> None:
    target = tmp_path / "points.svg"

    assert graph.trundle("plot", "/points/point/x:y", "-b", str(bag), "-o", str(target)) == (0, "", "")

    rising, level = _lines(target.read_text())
    assert rising[0][1] > rising[-1][1], "y of a picture points down"
    assert len({y for _, y in level}) == 1
    assert ">/points/point/x<" in target.read_text()


def test_each_number_of_an_array_is_a_curve(graph: Any, bag: Path) -> None:
    code, text, _ = graph.trundle("plot", "/joints/position", "-b", str(bag))
    assert code == 0
    assert "* /joints/position[0] = 1\n" in text
    assert re.search(r"\+ /joints/position\[1\] = \d+", text)


def test_a_running_topic_is_drawn(graph: Any, tmp_path: Path) -> None:
    node = graph.node("ticker")
    publisher = node.advertise("/speed", "std_msgs/Float32")
    graph.ready(node)

    async def talk() -> None:
        while True:
            publisher.publish({"data": 0.5})
            await WallClock().sleep(0.01)

    talking = graph.loop.spawn(talk())
    target = tmp_path / "speed.svg"
    assert graph.trundle("plot", "/speed/data", "--duration", "0.5", "-o", str(target)) == (0, "", "")
    code, text, _ = graph.trundle("plot", "/speed/data", "--duration", "0.1")
    talking.cancel()
    assert code == 0
    assert len(_lines(target.read_text())[0]) > 2
    assert "* /speed/data = 0.5" in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["/points/header/frame_id"], "/points/header/frame_id is a string, not a number"),
        (["/points/point"], "/points/point is a geometry_msgs/Point, not a number; fields here: x, y, z"),
        (["/points/point/w"], "no field named w in geometry_msgs/Point; fields here: x, y, z"),
        (["/none"], "no topic of /none in "),
        (["/points/point/x", "-o", "x.png"], "x.png does not end in .svg"),
    ],
)
def test_errors_are_one_sentence(graph: Any, bag: Path, words: list[str], message: str) -> None:
    code, _, error = graph.trundle("plot", *words, "-b", str(bag))
    assert (code, error.startswith(f"ERROR: {message}")) == (1, True), error


def test_a_curve_is_interrupted_at_nan_and_infinity() -> None:
    curve = Curve("c", [(0.0, 1.0), (1.0, 2.0), (2.0, math.nan), (3.0, math.inf), (4.0, 1.0), (5.0, 1.0)])
    assert len(_lines(curves_svg([curve]))) == 2
    assert "*" in curves_text([curve], columns=60, rows=10)


def test_ticks_of_large_close_numbers_have_enough_digits() -> None:
    """Map coordinates and stamps: all ticks of the axis used to be 4.5e+06."""
    curve = Curve("easting", [(0.0, 4_500_000.0), (1.0, 4_500_000.5)])
    marks = [text.text for text in parse_xml(curves_svg([curve]), name="x.svg").all("text")]
    assert {"4500000", "4500000.2", "4500000.4"} <= set(marks)
    text = curves_text([curve], columns=60, rows=10)
    assert "easting = 4500000.5" in text
    assert max(map(len, text.splitlines())) <= 60


def test_noise_of_a_constant_is_not_magnified() -> None:
    (line,) = _lines(curves_svg([Curve("x", [(0.0, 0.8), (1.0, 0.8 + 1e-10)])]))
    assert line[0][1] == line[1][1]


def test_the_largest_double_is_not_drawn() -> None:
    curve = Curve("limit", [(0.0, sys.float_info.max), (1.0, -sys.float_info.max), (2.0, 1.0), (3.0, 2.0)])
    (line,) = _lines(curves_svg([curve]))
    assert len(line) == 2
    assert "limit = 2" in curves_text([curve], columns=60, rows=10)


def test_a_spike_among_a_hundred_thousand_points_is_drawn() -> None:
    points = [(i / 1000, float(i == 54_321)) for i in range(100_000)]
    (line,) = _lines(curves_svg([Curve("c", points)]))
    assert len(line) < 4000
    assert len({y for _, y in line}) == 2
