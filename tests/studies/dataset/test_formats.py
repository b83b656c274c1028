"""Formats, read as their tools read them."""

import json
import math
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml
from numpy.typing import NDArray
from PIL import Image

import trundle
from trundle.ros import Messages, open_bag
from trundle.studies.datasets.overlay import category_color

SIZE = (320, 240)
WORLD = """<sdf version="1.6"><world name="w"><model name="floor"><static>1</static><link name="l">
<collision name="c"><geometry><box><size>9 9 0.1</size></box></geometry></collision>
<visual name="v"><geometry><box><size>9 9 0.1</size></box></geometry></visual></link></model></world></sdf>"""
MODEL = """<sdf version="1.6"><model name="m"><link name="body">
<collision name="c"><geometry>{shape}</geometry></collision>
<visual name="v"><geometry>{shape}</geometry></visual></link></model></sdf>"""
PLAN = """\
world: world.sdf
count: 3
size: [320, 240]
samples: 1
formats: [yolo, kitti, semantic_kitti, mcap, parquet]
camera: {position: [-4, 0, 0.6], look_at: [0, 0, 0.6], fov: 1.0}
objects:
  car: {model: car.sdf, count: 2, surface: floor, within: {x: [-1, 2], y: [-1, 1]}, key_points: {top: [0, 0, 0.25]}}
  ball: {model: ball.sdf, surface: floor, within: {x: [-1, 2], y: [-1, 1]}, key_points: {centre: [0, 0, 0]}}
lidar: {beams: 32, columns: 720, horizontal: [-0.6, 0.6], vertical: [-0.4, 0.2], pose: [0.1, 0, 0.2, 0, 0, 0]}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Dataset in every format but COCO."""
    pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
    folder = tmp_path_factory.mktemp("formats")
    (folder / "world.sdf").write_text(WORLD)
    (folder / "car.sdf").write_text(MODEL.format(shape="<box><size>0.8 0.4 0.5</size></box>"))
    (folder / "ball.sdf").write_text(MODEL.format(shape="<sphere><radius>0.2</radius></sphere>"))
    (folder / "plan.yaml").write_text(PLAN)
    return trundle.dataset(folder / "plan.yaml").folder


def records(folder: Path) -> list[dict[str, Any]]:
    """Read the records."""
    return [json.loads((folder / f"records/{number:06}.json").read_text()) for number in range(3)]


def instances(folder: Path, number: int) -> NDArray[np.uint16]:
    """Read a segmentation."""
    return np.array(Image.open(folder / f"segmentation/{number:06}.png"))


def test_yolo_boxes_are_shares_of_the_picture(folder: Path) -> None:
    data = yaml.safe_load((folder / "data.yaml").read_text())
    assert data == {"train": "images", "val": "images", "names": {0: "car", 1: "ball"}, "kpt_shape": [1, 3]}
    for number, record in enumerate(records(folder)):
        lines = (folder / f"labels/{number:06}.txt").read_text().splitlines()
        assert len(lines) == len(record["objects"])
        for line, annotation in zip(lines, record["objects"], strict=True):
            kind, x, y, width, height, px, py, mark = map(float, line.split())
            assert data["names"][int(kind)] == annotation["category"]
            corners = [x - width / 2, y - height / 2, x + width / 2, y + height / 2]
            assert np.array(corners) * (SIZE * 2) == pytest.approx(annotation["box"], abs=1e-3)
            (point,) = annotation["key_points"]
            assert (px * 320, py * 240) == pytest.approx(point["pixel"], abs=1e-3)
            assert mark == (2 if point["is_visible"] else 1)


def test_kitti_boxes_project_onto_their_pixels(folder: Path) -> None:
    """As the devkit's computeBox3D and projectToImage do it."""
    base, visible_count = folder / "kitti/training", 0
    for number in range(3):
        calibration = _calibration(base / f"calib/{number:06}.txt")
        for line in (base / f"label_2/{number:06}.txt").read_text().splitlines():
            kind, *words = line.split()
            truncated, occluded, alpha, *box, h, w, l, x, y, z, turn = map(float, words)  # noqa: E741 - the devkit's
            assert 0 <= truncated <= 1
            assert occluded in (0, 1, 2)
            assert alpha == pytest.approx(math.remainder(turn - math.atan2(x, z), math.tau), abs=0.02)
            c, s = math.cos(turn), math.sin(turn)
            rotation = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
            corners = np.array([(a * l / 2, b, d * w / 2) for a in (-1, 1) for b in (0, -h) for d in (-1, 1)])
            placed = corners @ rotation.T + (x, y, z)
            columns, rows, depths = calibration["P2"].reshape(3, 4) @ np.hstack([placed, np.ones((8, 1))]).T
            columns, rows = columns / depths, rows / depths
            if kind == "car" and truncated == 0:
                found = [columns.min(), rows.min(), columns.max(), rows.max()]
                assert found == pytest.approx(box, abs=1.5)
                visible_count += 1
            assert y == pytest.approx(0.55, abs=0.02), "it stands on the floor, which the level camera has below it"
    assert visible_count >= 3


def _calibration(path: Path) -> dict[str, NDArray[np.float64]]:
    lines = (line.split(":") for line in path.read_text().splitlines())
    return {name: np.array(numbers.split(), dtype=float) for name, numbers in lines}


def test_lidar_points_land_on_the_pixels_of_their_instance(folder: Path) -> None:
    base, hits = folder / "semantic_kitti/sequences/00", 0
    names = yaml.safe_load((folder / "semantic_kitti/labels.yaml").read_text())["labels"]
    assert names == {0: "unlabeled", 1: "car", 2: "ball"}
    calibration = _calibration(base / "calib.txt")
    for number, record in enumerate(records(folder)):
        points = np.fromfile(base / f"velodyne/{number:06}.bin", dtype=np.float32).reshape(-1, 4)
        labels = np.fromfile(base / f"labels/{number:06}.label", dtype=np.uint32)
        assert len(points) == len(labels)
        kitti = (folder / f"kitti/training/velodyne/{number:06}.bin").read_bytes()
        assert kitti == points.tobytes()
        classes = {annotation["instance"]: annotation["category"] for annotation in record["objects"]}
        homogeneous = np.hstack([points[:, :3], np.ones((len(points), 1))])
        optical = homogeneous @ calibration["Tr"].reshape(3, 4).T
        columns, rows, depths = calibration["P2"].reshape(3, 4) @ np.hstack([optical, np.ones((len(points), 1))]).T
        u, v = np.rint(columns / depths).astype(int), np.rint(rows / depths).astype(int)
        inside = (u >= 0) & (u < SIZE[0]) & (v >= 0) & (v < SIZE[1])
        near = np.array(Image.open(folder / f"depth/{number:06}.png"))[v[inside], u[inside]] / 1000
        same = np.abs(near - depths[inside]) < 0.05  # what the camera sees too, from half a metre below
        agree = (instances(folder, number)[v[inside], u[inside]] == labels[inside] >> 16)[same]
        assert agree.mean() > 0.97, "all but points at edges"
        for label in np.unique(labels[labels > 0]):
            if label >> 16 in classes:
                assert names[int(label & 0xFFFF)] == classes[int(label >> 16)]
                hits += 1
    assert hits >= 6
    assert len((base / "poses.txt").read_text().splitlines()) == 3


def test_depths_are_in_the_unit_of_their_format(folder: Path) -> None:
    depth = np.array(Image.open(folder / "depth/000000.png"))
    kitti = np.array(Image.open(folder / "kitti/training/depth_2/000000.png"))
    assert depth.dtype == kitti.dtype == np.uint16
    floor = depth[-1, 160] / 1000
    assert floor == pytest.approx(0.55 / (math.tan(0.5) * 0.75 * 239 / 240), rel=0.01)  # 0.55 m below the camera
    assert kitti[-1, 160] / 256 == pytest.approx(floor, abs=1 / 256)
    assert depth[0, 160] == 0, "nothing above the floor"


def test_an_mcap_shard_has_the_messages_of_each_picture(folder: Path) -> None:
    messages, count = Messages(), {}
    with open_bag(folder / "mcap/000000-000002.mcap") as bag:
        for entry in bag.messages():
            message = messages.deserialize(entry.data, entry.connection.type)
            topic = entry.connection.topic
            number = count.get(topic, 0)
            count[topic] = number + 1
            record = records(folder)[number]
            if topic == "/camera/depth":
                pixels = np.frombuffer(bytes(message.data), dtype="<u2").reshape(SIZE[::-1])
                assert np.array_equal(pixels, np.array(Image.open(folder / f"depth/{number:06}.png")))
            if topic == "/camera/image/compressed":
                assert bytes(message.data) == (folder / f"images/{number:06}.png").read_bytes()
            if topic == "/camera/camera_info":
                assert message.K[0] == pytest.approx(record["camera"]["fx"])
            if topic == "/camera/detections":
                assert [detection.bbox.size_x for detection in message.detections] == [
                    annotation["box"][2] - annotation["box"][0] for annotation in record["objects"]
                ]
            if topic == "/record":
                assert json.loads(message.data) == record
    assert set(count.values()) == {3}
    assert len(count) == 8


def test_a_parquet_shard_has_pictures_and_records(folder: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow, of the extra `sweep`, is not installed")
    table = parquet.read_table(folder / "parquet/000000-000002.parquet")
    assert json.loads(table.schema.metadata[b"huggingface"])["info"]["features"]["image"] == {"_type": "Image"}
    for row, record in zip(table.to_pylist(), records(folder), strict=True):
        name = f"{row['number']:06}.png"
        assert row["image"] == {"bytes": (folder / "images" / name).read_bytes(), "path": name}
        assert [annotation["box"] for annotation in row["objects"]] == [
            annotation["box"] for annotation in record["objects"]
        ]
        assert row["camera"] == record["camera"]


def test_the_contact_sheet_opens_alone(folder: Path) -> None:
    html = (folder / "contact_sheet.html").read_text()
    assert not re.search(r'(?:src|href)="(?!data:image/webp)|url\(|@import', html), "it loads nothing"
    ElementTree.fromstring(
        re.sub(r"<((?:meta|img|input)[^>]*)>", r"<\1/>", html.removeprefix("<!doctype html>")).replace(" checked", "")
    )
    assert html.count("<figure>") == 3
    with Image.open(folder / "contact_sheet.png") as sheet:
        assert sheet.width == 3 * 406 + 6
        colors = sheet.convert("RGB").getcolors(1 << 24)
    assert colors is not None
    assert category_color(0) in {color for _, color in colors}, "boxes are drawn"
